// Methods at the same largest error and at the same RMS, and the pairs that change places.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>
#include <string>

#include "experiments/cross/lod/ranks.h"
#include "experiments/cross/lod/tuned_cases.h"
#include "lod/meters/screen_error.h"
#include "results/claims/claims.h"
#include "tests/experiments/value.h"

namespace terrabench::cross {
namespace {

using testing::ElementsAre;

TEST(Ranks, CountTheSmallerCosts) {
  const double costs[] = {30, 10, 20, 10};
  EXPECT_THAT(ranks(costs), ElementsAre(4, 1, 3, 1));
}

TEST(Flips, CountPairsThatChangePlaces) {
  const std::optional<double> one[] = {1, 2, 3}, same[] = {10, 20, 30}, turned[] = {3, 2, 1},
                              tied[] = {2, 2, 3}, lacking[] = {3, std::nullopt, 1}, close[] = {2.08, 2, 3},
                              apart[] = {2.2, 2, 3};
  EXPECT_EQ(count_flips(one, same).flipped, 0U);
  EXPECT_EQ(count_flips(one, same).pairs, 3U);
  EXPECT_EQ(count_flips(one, turned).flipped, 3U);
  EXPECT_EQ(count_flips(one, tied).flipped, 0U);
  EXPECT_EQ(count_flips(one, close).flipped, 0U);
  EXPECT_EQ(count_flips(one, apart).flipped, 1U);
  EXPECT_EQ(count_flips(one, lacking).pairs, 1U);
  EXPECT_EQ(count_flips(one, lacking).flipped, 1U);
}

// Over the frames of the search, no visible sample exceeds the largest error that was asked for, and the RMS
// is the one that was asked for.
TEST(TuneTo, MakesTheFigureOfItsCriterionEqual) {
  Progress progress;
  Flight flight({"fractal", "low", 257, 6, 1}, progress);
  const ConfiguredMethod method = named_method("mrbsp", "");
  for (const Criterion criterion : {Criterion::kLargest, Criterion::kRms, Criterion::kP99}) {
    const Tuned tuned = tune_to(flight, method, 2, progress, criterion);
    ASSERT_TRUE(tuned.reached);
    const std::unique_ptr<Lod> lod = method.build(flight.ground(), progress);
    lod->tune(tuned.knob);
    Distribution errors;
    for (std::size_t k = 0; k < flight.metered.size(); k += 2) {
      const SurfaceRaster drawn(lod->update(flight.views[flight.metered[k]]), 257, 257);
      screen_error(drawn, flight.ground(), flight.seen[k], &errors);
    }
    EXPECT_EQ(figure_of(errors, criterion), tuned.error);
    EXPECT_LE(tuned.error, 2);
    EXPECT_GT(tuned.error, 1);
  }
  EXPECT_GT(tune_to(flight, method, 2, progress, Criterion::kLargest).knob,
            tune_to(flight, method, 2, progress, Criterion::kRms).knob)
      << "the largest error is the stricter figure, and this knob is finer when it is larger";
}

TEST(LodRanks, MeasuresEveryMethodUnderBothErrors) {
  const Experiment& compared = experiment("cross.lod-ranks");
  const Case at{"small",
                {compared.parameters,
                 {{"path", std::string("low")}, {"frames", std::int64_t{4}}, {"size", std::int64_t{65}}}},
                "fractal"};
  Record record;
  Recorder recorder(record, "unused");
  Progress progress;
  compared.measure(at, {}, recorder, progress);
  const auto value = [&](const std::string& metric) { return terrabench::value(record, metric); };
  std::set<double> rank_of_largest;
  for (const Entrant& entrant : entrants()) {
    for (const char* const criterion : {"largest", "rms"}) {
      const std::string prefix = fmt::format("{}_{}_", entrant.name, criterion);
      EXPECT_GT(value(prefix + "triangles"), 0);
      EXPECT_GT(value(prefix + "uploaded"), 0);
      EXPECT_GE(value(prefix + "error_largest"), value(prefix + "error_rms"));
      EXPECT_GE(value(prefix + "rank_triangles"), 1);
    }
    rank_of_largest.insert(value(entrant.name + "_largest_rank_triangles"));
    EXPECT_GE(value(entrant.name + "_largest_triangles"), 1);
  }
  EXPECT_GT(rank_of_largest.size(), 4U);
  EXPECT_EQ(value("brute_force_rms_error_largest"), 0);
  EXPECT_LE(value("flips_triangles"), value("pairs"));
  EXPECT_LE(value("flips_uploaded"), value("pairs"));
  const std::size_t n = entrants().size();
  EXPECT_LE(value("pairs"), static_cast<double>(n * (n - 1) / 2));
}

// A method added to the registry must appear in every table: one line in the set `tuned`.
TEST(LodTables, ShowEveryEntrantWithBruteForceBeside) {
  std::size_t tables = 0;
  for (const Paper& paper : papers()) {
    for (const TableLayout& table : paper.tables) {
      if (!table.id.starts_with("cross.lod-ranks-")) continue;
      ++tables;
      std::set<std::string> shown;
      for (const TableLayout::Row& row : table.rows)
        shown.insert(std::get<std::string>(row.values.find("method")->second));
      for (const Entrant& entrant : entrants()) EXPECT_TRUE(shown.contains(entrant.name)) << entrant.name;
      EXPECT_EQ(shown.size(), entrants().size());
    }
  }
  EXPECT_EQ(tables, 5U);
}

}  // namespace
}  // namespace terrabench::cross
