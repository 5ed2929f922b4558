// The experiments of the hybrid paper's §3.5 at small sizes: they measure what the claims read.
#include <gtest/gtest.h>

#include <string>

#include "tests/experiments/value.h"

namespace terrabench {
namespace {

Record measured(std::string_view id, std::string_view case_name,
                std::initializer_list<std::string> settings) {
  for (Case at : experiment(id).cases({})) {
    if (at.name != case_name) continue;
    for (const std::string& setting : settings) at.parameters.set_from_text(setting);
    return measured_case(id, at);
  }
  ADD_FAILURE() << "no case " << case_name;
  return {};
}

TEST(HybridRim, HasNoOpeningsUnlessItIsOnlyCut) {
  for (const char* const name : {"caves/rest", "canyon/walk"}) {
    const Record joined = measured("hybrid.stitch", name, {"n=128", "views=3"});
    EXPECT_EQ(value(joined, "views"), 3);
    EXPECT_EQ(value(joined, "views_with_rim"), 3);
    for (const char* const metric :
         {"open_edges", "largest_gap", "largest_gap_on_screen", "bare_pixels", "pixels_covered_twice"}) {
      EXPECT_EQ(value(joined, metric), 0) << name << " " << metric;
    }
  }
  const Record cut = measured("hybrid.stitch", "caves/rest-cut-alone", {"n=128", "views=4"});
  EXPECT_GT(value(cut, "open_edges"), 0);
  EXPECT_GT(value(cut, "largest_gap"), 0);
  EXPECT_GT(value(cut, "bare_pixels"), 0);
}

TEST(HybridRim, NearDetailAloneDrawsLessThanDetailEverywhere) {
  const Record small = measured("hybrid.less-geometry", "finer=1/radius=0", {"n=128", "views=3"});
  const Record large = measured("hybrid.less-geometry", "finer=1/radius=1", {"n=128", "views=3"});
  EXPECT_EQ(value(small, "implicit_triangles"), value(large, "implicit_triangles"));
  EXPECT_LT(value(small, "near_triangles"), value(small, "triangles"));
  EXPECT_LT(value(small, "triangles"), value(large, "triangles"));
  EXPECT_LT(value(large, "ratio"), 1);
}

TEST(HybridRim, OnlyTheSumOfSolidLayersSinks) {
  const Record top = measured("hybrid.sum-heights", "top", {"n=48"}),
               sum = measured("hybrid.sum-heights", "sum", {"n=48"});
  EXPECT_EQ(value(top, "sunk_columns"), 0);
  EXPECT_EQ(value(top, "dents"), 0);
  EXPECT_GT(value(sum, "columns_with_caves"), 100);
  EXPECT_EQ(value(sum, "sunk_columns"), value(sum, "columns_with_caves"));
  EXPECT_GT(value(sum, "dents"), 0);
  EXPECT_LT(value(sum, "dents"), value(sum, "sunk_columns"));
}

}  // namespace
}  // namespace terrabench
