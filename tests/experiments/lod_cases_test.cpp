// The experiments that compare all methods, tuned to the same error, case by case: jumps of the camera, open
// seams, the drawn against the true ground, and edits.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <set>
#include <string>

#include "experiments/cross/lod/tuned_cases.h"
#include "results/claims/claims.h"
#include "results/store/statistics.h"
#include "tests/experiments/value.h"

namespace terrabench::cross {
namespace {

constexpr std::string_view kExperiments[] = {"cross.lod-jump", "cross.lod-seams", "cross.lod-surface",
                                             "cross.lod-edit"};

TEST(TunedCases, TakeEveryMethodAndTheTablesShowThem) {
  for (const std::string_view id : kExperiments) {
    for (const Profile profile : {Profile::kQuick, Profile::kPaper}) {
      const std::size_t grounds = profile == Profile::kQuick ? 2 : 5;
      RunOptions options;
      options.profile = profile;
      EXPECT_EQ(experiment(id).cases(options).size(), grounds * entrants().size());
    }
    std::size_t tables = 0;
    for (const Paper& paper : papers()) {
      for (const TableLayout& table : paper.tables) {
        if (table.experiment != id) continue;
        ++tables;
        EXPECT_EQ(table.rows.size(), entrants().size()) << table.id;
      }
    }
    EXPECT_GE(tables, 3U) << id;
  }
}

// The set `joining` in the claims names exactly the entrants whose method can leave its joins out.
TEST(TunedCases, ClaimsJudgeOpenSeamsOfEveryMethodThatHasThem) {
  std::set<std::string> judged, able;
  for (const Paper& paper : papers()) {
    for (const Claim& claim : paper.claims) {
      if (claim.id != "cross.lod-seams") continue;
      for (const Condition& condition : claim.conditions) {
        for (const Operand& operand : condition.operands) {
          if (operand.metric == "open_crack_pixels")
            judged.insert(operand.case_name.substr(operand.case_name.find('/') + 1));
        }
      }
    }
  }
  for (const Entrant& entrant : entrants()) {
    if (!lod(entrant.method).unstitched.empty()) able.insert(entrant.name);
  }
  EXPECT_EQ(judged, able);
}

class TunedCase : public ::testing::TestWithParam<std::string> {
 protected:
  static Record measure(std::string_view id) {
    const Experiment& compared = experiment(id);
    const Case at{"small",
                  {compared.parameters,
                   {{"method", GetParam()},
                    {"path", std::string("fly")},
                    {"frames", std::int64_t{4}},
                    {"size", std::int64_t{129}}}},
                  "fractal"};
    Record record;
    Recorder recorder(record, "unused");
    Progress progress;
    compared.measure(at, {}, recorder, progress);
    return record;
  }
  static bool is_brute() { return GetParam() == "brute_force"; }
};

TEST_P(TunedCase, JumpsAndConverges) {
  const Record record = measure("cross.lod-jump");
  EXPECT_EQ(value(record, "frames_to_error_most"), 1);
  EXPECT_GE(value(record, "frames_to_equal_most"), 1);
  EXPECT_LE(value(record, "triangles_differing"), value(record, "fresh_triangles"));
  EXPECT_GT(value(record, "jump_uploaded"), 0);
  EXPECT_EQ(value(record, "first_error_largest") > 0, !is_brute());
  EXPECT_EQ(value(record, "jumps"), 4);
}

TEST_P(TunedCase, ShowsPixelsThroughOpenSeamsOnly) {
  const Record record = measure("cross.lod-seams");
  EXPECT_EQ(value(record, "crack_pixels"), 0);
  EXPECT_GT(value(record, "triangles"), 0);
  const Entrant* of = nullptr;
  const std::vector<Entrant> all = entrants();
  for (const Entrant& entrant : all) of = entrant.name == GetParam() ? &entrant : of;
  ASSERT_NE(of, nullptr);
  EXPECT_EQ(value(record, "gaps") == 0, lod(of->method).traits.conforming);
  if (lod(of->method).unstitched.empty()) {
    EXPECT_EQ(record.find("open_crack_pixels"), nullptr);
  } else {
    EXPECT_GT(value(record, "open_gaps"), 0);
    EXPECT_GT(value(record, "open_crack_pixels"), 0);
  }
}

TEST_P(TunedCase, StandsAboveAndBelowTheGround) {
  const Record record = measure("cross.lod-surface");
  EXPECT_GT(value(record, "samples"), 1000);
  EXPECT_EQ(value(record, "above_largest") > 0, !is_brute());
  EXPECT_EQ(value(record, "below_rms") > 0, !is_brute());
  EXPECT_GE(value(record, "above_largest"), value(record, "above_rms"));
  EXPECT_EQ(value(record, "under_water") + value(record, "over_water"), value(record, "samples"));
  EXPECT_EQ(value(record, "collision_missed"), 0);
  EXPECT_EQ(value(record, "collision_points"), 4 * 4096);
  EXPECT_LE(value(record, "collision_rms"), value(record, "collision_largest"));
  if (is_brute()) {
    EXPECT_LT(value(record, "collision_largest"), 1e-3);
  }
  EXPECT_GT(value(record, "queries"), 0);
}

// The index of the drawn surface is filled by all threads, in any order.
TEST_P(TunedCase, StandsTheSameForAnyNumberOfThreads) {
  const auto exact = [](int threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    std::vector<Metric> metrics = measure("cross.lod-surface").metrics;
    std::erase_if(metrics, [](const Metric& m) { return is_timing(m.unit); });
    return metrics;
  };
  const std::vector<Metric> one = exact(1), four = exact(4);
  ASSERT_EQ(one.size(), four.size());
  for (std::size_t i = 0; i < one.size(); ++i) EXPECT_EQ(one[i].samples, four[i].samples) << one[i].name;
}

TEST_P(TunedCase, DrawsAnEditAsIfBuiltAnew) {
  const Record record = measure("cross.lod-edit");
  const Metric* const differing = record.find("triangles_differing_most");
  ASSERT_NE(differing, nullptr);
  EXPECT_THAT(differing->samples, testing::Each(0));
  EXPECT_GT(value(record, "triangles_changed"), 0);
  EXPECT_LT(value(record, "uploaded"), value(record, "rebuild_uploaded"));
}

std::vector<std::string> names() {
  std::vector<std::string> all;
  for (const Entrant& entrant : entrants()) all.push_back(entrant.name);
  return all;
}
INSTANTIATE_TEST_SUITE_P(EachMethod, TunedCase, ::testing::ValuesIn(names()),
                         [](const auto& info) { return info.param; });

}  // namespace
}  // namespace terrabench::cross
