// The figures of where each type of representation errs.
#include <gtest/gtest.h>

#include "experiments/experiment.h"
#include "experiments/figures/maps.h"
#include "representations/representation.h"
#include "results/plot/figure_layout.h"
#include "terrain/image.h"
#include "tests/terrain/temporary_folder.h"

namespace terrabench::cross {
namespace {

class ErrorMaps : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Grounds, ErrorMaps, testing::Values("fractal", "caves"),
                         [](const auto& at) { return std::string(at.param); });

TEST_P(ErrorMaps, ShowEveryTypeWithItsBytesAndItsError) {
  const Experiment& maps = experiment("cross.error-maps");
  const Case at{GetParam(),
                {maps.parameters,
                 {{"share", 0.3},
                  {"builds", std::int64_t{8}},
                  {"size", std::int64_t{65}},
                  {"resolution", std::int64_t{32}},
                  {"lines", std::int64_t{80}}}},
                GetParam()};
  const TemporaryFolder folder;
  Record record;
  Recorder recorder(record, folder.path());
  Progress progress;
  maps.measure(at, {}, recorder, progress);
  ASSERT_EQ(record.figures.size(), 1U);
  const std::filesystem::path file = folder.path() / record.figures[0].file;
  const FigureLayout& layout = record.figures[0].layout;
  EXPECT_EQ(layout.panels.size(), representations().size());
  EXPECT_EQ(layout_fault(layout, read_picture(file)), "");
  const Metric *const kept = record.find("columns"), *const lost = record.find("lost_columns");
  ASSERT_TRUE(kept != nullptr && lost != nullptr);
  EXPECT_GT(kept->samples[0], 80 * 70);
  EXPECT_EQ(kept->samples[0] + lost->samples[0], 80 * 80);
  for (const RepresentationType& type : representations()) {
    for (const char* const metric : {"_rmse", "_file"}) {
      const Metric* const found = record.find(std::string(type.name) + metric);
      ASSERT_NE(found, nullptr) << type.name;
      EXPECT_GT(found->samples[0], 0) << type.name;
      EXPECT_TRUE(says(layout, found->samples[0])) << type.name << metric;
    }
  }
}

// DEMs of one file name must not draw into one file; names in the catalogue keep the ids that claims read.
TEST(GroundSuffix, TellsPathsApartAndKeepsNames) {
  EXPECT_EQ(figures::ground_suffix("jacksboro", "jacksboro"), "");
  EXPECT_EQ(figures::ground_suffix("planet-faults", "jacksboro"), ".planet-faults");
  const std::string x = figures::ground_suffix("/x/caves", "jacksboro");
  EXPECT_EQ(x.substr(0, 7), ".caves-");
  EXPECT_NE(x, figures::ground_suffix("/y/caves", "jacksboro"));
  EXPECT_NE(x, figures::ground_suffix("caves", "jacksboro"));
}

}  // namespace
}  // namespace terrabench::cross
