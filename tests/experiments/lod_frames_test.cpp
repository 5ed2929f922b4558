// Whole frames at equal error: which figures are recorded, how they relate, and which sizes are left out.
// Nothing here depends on how long anything takes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>
#include <string>

#include "experiments/cross/lod/frame_cost.h"
#include "results/claims/claims.h"
#include "results/store/statistics.h"

namespace terrabench::cross {
namespace {

TEST(Crossing, IsInterpolatedInLogarithms) {
  const Crossing found = crossing({100, 10'000, 1e6}, {4, 0.25, 0.1});
  EXPECT_FALSE(found.everywhere || found.nowhere);
  EXPECT_NEAR(found.from, 1000, 1e-9);
  EXPECT_NEAR(crossing({1e2, 1e4}, {1, 0.5}).from, 100, 1e-9) << "equal cost is not less";
}

TEST(Crossing, SaysWhereThereIsNone) {
  EXPECT_TRUE(crossing({1e2, 1e4}, {0.9, 0.5}).everywhere);
  EXPECT_TRUE(crossing({1e2, 1e4}, {3, 2}).nowhere);
  EXPECT_TRUE(crossing({1e2, 1e4}, {0.5, 1.5}).nowhere) << "only the larger sizes count";
  EXPECT_TRUE(crossing({1e2}, {0.5}).everywhere);
  EXPECT_TRUE(crossing({1e2}, {1}).nowhere);
  for (const auto& ratios : {std::vector{0.9, 0.5}, {3.0, 2.0}})
    EXPECT_EQ(crossing({1e2, 1e4}, ratios).from, 0);
}

TEST(Crossing, CountsFromTheLastSizeThatCostsMore) {
  const Crossing found = crossing({1e2, 1e4, 1e6, 1e8}, {0.5, 2, 0.5, 0.1});
  EXPECT_NEAR(found.from, 1e5, 1e-6);
}

class LodFrames : public ::testing::Test {
 protected:
  static Record measure(const std::string& terrain, double seconds, std::int64_t largest = 129) {
    const Experiment& compared = experiment("cross.lod-frames");
    const Case at{terrain,
                  {compared.parameters,
                   {{"frames", std::int64_t{4}},
                    {"smallest", std::int64_t{65}},
                    {"largest", largest},
                    {"seconds", seconds}}},
                  terrain};
    Record record;
    Recorder recorder(record, "unused");
    Progress progress;
    compared.measure(at, {}, recorder, progress);
    return record;
  }
  static const std::vector<double>& samples(const Record& record, const std::string& metric) {
    static const std::vector<double> kNone;
    const Metric* const found = record.find(metric);
    EXPECT_NE(found, nullptr) << metric;
    return found == nullptr ? kNone : found->samples;
  }
  static double value(const Record& record, const std::string& metric) {
    const std::vector<double>& all = samples(record, metric);
    return all.empty() ? -1 : median(all);
  }
  // What is recorded of one method on one ground.
  static void check(const Record& record, const std::string& of, const std::string& brute) {
    const std::vector<double>& whole = samples(record, of + "_frame");
    EXPECT_GE(whole.size(), 6U) << of;
    EXPECT_EQ(whole.size(), samples(record, brute + "_frame").size()) << "repetitions are of all methods";
    for (std::size_t k = 0; k < whole.size(); ++k) {
      const double sum = samples(record, of + "_choose")[k] + samples(record, of + "_send")[k] +
                         samples(record, of + "_draw")[k];
      EXPECT_DOUBLE_EQ(samples(record, of + "_sum")[k], sum);
      EXPECT_DOUBLE_EQ(samples(record, of + "_of_brute")[k], whole[k] / samples(record, brute + "_frame")[k]);
      EXPECT_GT(samples(record, of + "_choose")[k], 0);
      EXPECT_GT(samples(record, of + "_draw")[k], 0);
    }
    EXPECT_GT(value(record, of + "_triangles"), 0);
    EXPECT_GT(value(record, of + "_sent"), 0);
    EXPECT_EQ(record.find(of + "_refused"), nullptr);
    if (of == brute) {
      EXPECT_EQ(value(record, of + "_error"), 0);
      return;
    }
    EXPECT_EQ(value(record, of + "_reached"), 1);
    // 2 px are asked of every other metered frame; of so few frames the others may lie higher.
    EXPECT_GT(value(record, of + "_error"), 0.5);
    EXPECT_LE(value(record, of + "_error"), 4);
    // On so small ground a clipmap's rings reach beyond it and take more triangles than all samples.
    if (of.starts_with("roam")) {
      EXPECT_LT(value(record, of + "_triangles"), value(record, brute + "_triangles"));
    }
  }
};

TEST_F(LodFrames, MeasuresEveryMethodAtEverySize) {
  const Record record = measure("fractal", 1e6);
  for (const LodType& type : lods()) {
    const std::string name(type.name);
    check(record, name + "_65", "brute_force_65");
    check(record, name + "_129", "brute_force_129");
    EXPECT_TRUE(std::isfinite(value(record, name + "_draw_exponent")));
    if (name == "brute_force") continue;
    EXPECT_THAT(samples(record, name + "_ratios_samples"), testing::ElementsAre(65 * 65, 129 * 129));
    EXPECT_DOUBLE_EQ(samples(record, name + "_ratios")[1], median(samples(record, name + "_129_of_brute")));
    const bool crosses = record.find(name + "_cheaper_from") != nullptr;
    EXPECT_EQ(value(record, name + "_cheaper_everywhere") + value(record, name + "_cheaper_nowhere") +
                  (crosses ? 1 : 0),
              1);
  }
  EXPECT_EQ(value(record, "frame_sizes"), 2);
  EXPECT_EQ(value(record, "frame_short_of_time"), 0);
  EXPECT_EQ(record.terrain, "fractal");
}

// Triangles, bytes and errors are the same in every run; only times and what follows from them vary.
TEST_F(LodFrames, CountsAreTheSameAgain) {
  const Record first = measure("fractal", 1e6), again = measure("fractal", 1e6);
  std::size_t compared = 0;
  for (const Metric& metric : first.metrics) {
    if (timed(metric)) continue;
    EXPECT_EQ(metric.samples, samples(again, metric.name)) << metric.name;
    ++compared;
  }
  EXPECT_GE(compared, 8 * lods().size());
}

TEST_F(LodFrames, SaysWhyASizeIsLeftOut) {
  const Record record = measure("fractal", 0);
  EXPECT_EQ(value(record, "frame_sizes"), 1);
  EXPECT_EQ(value(record, "frame_short_of_time"), 1);
  EXPECT_EQ(record.find("roam_129_frame"), nullptr);
  EXPECT_EQ(record.find("roam_draw_exponent"), nullptr) << "one size has no growth";
}

TEST_F(LodFrames, OtherGroundsHaveOneSize) {
  const Record record = measure("peak", 1e6, 65);
  EXPECT_EQ(record.find("frame_sizes"), nullptr);
  EXPECT_EQ(record.find("roam_cheaper_from"), nullptr);
  EXPECT_GT(value(record, "brute_force_triangles"), 0);
}

// A method added to the registry must appear in the table and the bars.
TEST(LodFramesLayouts, ShowEveryMethodOnEveryGround) {
  std::set<std::string> known;
  for (const LodType& type : lods()) known.insert(std::string(type.name));
  const auto check = [&](const std::vector<TableLayout::Row>& rows) {
    std::map<std::string, std::set<std::string>> by_ground;
    for (const TableLayout::Row& row : rows) {
      const std::string of = for_row("<of>", row);
      const std::size_t end = of.find_last_not_of("0123456789_") + 1;
      by_ground[row.case_name + of.substr(end)].insert(of.substr(0, end));
    }
    EXPECT_EQ(by_ground.size(), 11U);
    for (const auto& [ground, methods] : by_ground) EXPECT_EQ(methods, known) << ground;
  };
  std::vector<TableLayout::Row> bars;
  for (const Paper& paper : papers()) {
    for (const TableLayout& table : paper.tables) {
      if (table.id == "cross.lod-frames.cost") check(table.rows);
    }
    for (const PlotLayout& plot : paper.plots) {
      if (!plot.id.starts_with("cross.lod-frames.bars-")) continue;
      EXPECT_EQ(plot.rows.size(), known.size() - 1) << plot.id;
      bars.insert(bars.end(), plot.rows.begin(), plot.rows.end());
    }
  }
  known.erase("brute_force");  // its bar would leave no room for the others
  check(bars);
}

}  // namespace
}  // namespace terrabench::cross
