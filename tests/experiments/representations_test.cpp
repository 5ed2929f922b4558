// The comparison of all representations: its cases, and what it measures on small ground.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>

#include "experiments/experiment.h"
#include "representations/representation.h"
#include "results/claims.h"
#include "results/statistics.h"

namespace terrabench::cross {
namespace {

constexpr std::string_view kId = "cross.representations";

Record measure(std::string_view type, const std::string& terrain, double share) {
  const Experiment& compared = experiment(kId);
  const Case at{"small",
                {compared.parameters,
                 {{"representation", std::string(type)},
                  {"share", share},
                  {"size", std::int64_t{65}},
                  {"resolution", std::int64_t{24}},
                  {"lines", std::int64_t{41}},
                  {"rays", std::int64_t{300}}}},
                terrain};
  Record record;
  Recorder recorder(record, "unused");
  Progress progress;
  compared.measure(at, {}, recorder, progress);
  return record;
}

double value(const Record& record, std::string_view metric) {
  const Metric* const found = record.find(metric);
  EXPECT_NE(found, nullptr) << metric;
  return found == nullptr ? -1 : summarise(found->samples).median;
}

TEST(RepresentationCases, NameEveryTypeAndTheLedgerReadsThem) {
  std::set<std::string> names;
  for (const Case& at : experiment(kId).cases({})) EXPECT_TRUE(names.insert(at.name).second) << at.name;
  for (const RepresentationType& type : representations()) {
    const std::string own = "caves/" + std::string(type.name);
    for (const char* const suffix : {"", "/1%", "/5%", "/20%"})
      EXPECT_TRUE(names.contains(own + suffix)) << own;
  }
  std::size_t rows = 0, operands = 0;
  for (const Paper& paper : papers()) {
    for (const TableLayout& table : paper.tables) {
      if (table.experiment != kId) continue;
      for (const TableLayout::Row& row : table.rows) {
        ++rows;
        EXPECT_TRUE(names.contains(row.case_name)) << row.case_name;
      }
    }
    for (const Claim& claim : paper.claims) {
      for (const Condition& condition : claim.conditions) {
        for (const Operand& operand : condition.operands) {
          if (operand.experiment != kId) continue;
          ++operands;
          EXPECT_TRUE(names.contains(operand.case_name)) << claim.id << ' ' << operand.case_name;
        }
      }
    }
  }
  EXPECT_GT(rows, 0U);
  EXPECT_GT(operands, 0U);
}

class Compared : public testing::TestWithParam<std::string_view> {};
INSTANTIATE_TEST_SUITE_P(Types, Compared,
                         testing::Values("heightmap", "layered_stack", "voxel", "dense_voxel", "implicit",
                                         "drill", "ght"),
                         [](const auto& at) { return std::string(at.param); });

TEST_P(Compared, HoldsHeights) {
  const Record found = measure(GetParam(), "fractal", 0);
  EXPECT_EQ(value(found, "bytes"), value(found, "heap_bytes"));
  EXPECT_EQ(value(found, "payload") + value(found, "index") + value(found, "slack"), value(found, "bytes"));
  EXPECT_EQ(value(found, "loaded_differs"), 0);
  EXPECT_EQ(value(found, "columns"), 65 * 65);
  EXPECT_EQ(value(found, "lost_columns"), 0);
  EXPECT_GT(value(found, "volume_iou"), 0.9);
  if (representation(GetParam()).traits.lossless) {
    EXPECT_EQ(value(found, "largest_error"), 0);
  } else {
    EXPECT_GT(value(found, "largest_error"), 0);
  }
  EXPECT_LE(value(found, "rmse"), value(found, "largest_error"));
  EXPECT_LE(value(found, "error_p99"), value(found, "largest_error"));
  EXPECT_EQ(value(found, "hausdorff"),
            std::max(value(found, "hausdorff_from_ground"), value(found, "hausdorff_to_ground")));
  if (value(found, "own_rays") == 1) {
    EXPECT_GT(value(found, "ray_agreement"), 0.8);
  }
  EXPECT_GT(value(found, "dig_time"), 0);
}

TEST_P(Compared, HoldsSolids) {
  const Record found = measure(GetParam(), "caves", 0);
  EXPECT_EQ(value(found, "bytes"), value(found, "heap_bytes"));
  EXPECT_GT(value(found, "cavities"), 0);
  const double lost = value(found, "cavities_lost");
  EXPECT_GE(lost, 0);
  EXPECT_LE(lost, 1);
  // 24 cells are too coarse for the implicit surface's kernel, and a tree takes overhangs from events alone.
  if (GetParam() == "heightmap" || GetParam() == "drill") {
    EXPECT_GT(lost, 0.9);
  } else if (GetParam() != "implicit" && GetParam() != "ght") {
    EXPECT_LT(lost, 0.6);
  }
}

TEST_P(Compared, TakesTheBytesAllowed) {
  const Record found = measure(GetParam(), "fractal", 0.2);
  EXPECT_EQ(value(found, "fits"), 1);
  EXPECT_LE(value(found, "file_bytes"), 0.2 * (65 * 65 * 4 + 200));
  EXPECT_LE(value(found, "of_budget"), 1);
  EXPECT_GT(value(found, "of_budget"), 0.4);
  EXPECT_GT(value(found, "rmse"), 0);
}

}  // namespace
}  // namespace terrabench::cross
