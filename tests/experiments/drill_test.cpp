#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "experiments/drill/analysis.h"
#include "experiments/drill/edges.h"
#include "experiments/drill/ground.h"
#include "experiments/drill/sweep.h"
#include "experiments/figures/maps.h"
#include "representations/drill/regenerate.h"
#include "terrain/hydrology/channels.h"
#include "tests/experiments/value.h"

namespace terrabench::drill {
namespace {

// Outcomes of the 54 settings with the RMSE that `error` gives.
template <class Error>
std::vector<Outcome> outcomes(const Error& error) {
  std::vector<Outcome> all;
  for (const Setting& setting : all_settings()) {
    Outcome& outcome = all.emplace_back();
    outcome.setting = setting;
    outcome.rmse = error(setting);
  }
  return all;
}

double rmse(const Outcome& outcome) { return outcome.rmse; }

constexpr double kInfinite = std::numeric_limits<double>::infinity();

TEST(DrillEffects, ShareTheVarianceOfTheLevelMeans) {
  const Effects one = main_effects(outcomes([](const Setting& s) { return 0.5 * s.w; }), rmse);
  EXPECT_NEAR(one.w, 1, 1e-12);
  EXPECT_NEAR(one.tau + one.k, 0, 1e-12);
  // Variances of the level means: 2/9 for 0, 1, 1 over three τ; 1 for 0 and 2 over six k.
  const auto all =
      outcomes([](const Setting& s) { return (s.tau > 25 ? 1.0 : 0.0) + (s.k > 15 ? 2.0 : 0.0); });
  const Effects two = main_effects(all, rmse);
  EXPECT_NEAR(two.tau, (2.0 / 9) / (2.0 / 9 + 1), 1e-12);
  EXPECT_NEAR(two.k, 1 / (2.0 / 9 + 1), 1e-12);
  EXPECT_NEAR(two.mean_at_tau[0], 1, 1e-12);
  EXPECT_NEAR(two.mean_at_tau[2], 2, 1e-12);
  // The sign changes with τ and with k, so that all level means are equal: no factor explains it.
  const Effects none = main_effects(outcomes([](const Setting& s) {
                                      const double tau = s.tau == 25 ? 1 : s.tau == 100 ? -1 : 0;
                                      return tau * (s.k > 15 ? 1 : -1);
                                    }),
                                    rmse);
  EXPECT_NEAR(none.tau + none.w + none.k, 0, 1e-12);
}

TEST(DrillEffects, SomeLevelsAloneAndNoVarianceAtAll) {
  auto all = outcomes([](const Setting& s) { return s.k == 5 ? 100.0 : s.tau; });
  std::erase_if(all, [](const Outcome& o) { return o.setting.k == 5; });
  EXPECT_NEAR(main_effects(all, rmse).tau, 1, 1e-12);
  const Effects none = main_effects(outcomes([](const Setting&) { return 3.0; }), rmse);
  EXPECT_EQ(none.tau + none.w + none.k, 0);
}

TEST(DrillAnalysis, OutliersLieBeyondTheUpperFence) {
  // Of 54 values the quartiles are those at 13.25 and 39.75: 14.25 and 40.75 when values count from 1.
  std::vector<Outcome> all;
  for (int i = 1; i <= 54; ++i) all.emplace_back().rmse = i;
  EXPECT_EQ(without_outliers(all, rmse).size(), 54U);
  all.back().rmse = 40.75 + 1.5 * 26.5;  // on the fence
  EXPECT_EQ(without_outliers(all, rmse).size(), 54U);
  all.back().rmse += 1e-6;
  EXPECT_EQ(without_outliers(all, rmse).size(), 53U);
}

TEST(DrillAnalysis, CountsTheCasesThatRiseAndDifferentFiniteValues) {
  EXPECT_EQ(rising_with_tau(outcomes([](const Setting& s) { return s.tau; }), rmse), 18);
  EXPECT_EQ(rising_with_tau(outcomes([](const Setting&) { return 1; }), rmse), 0);
  // Rises to 100 and falls to 200, at w = 5 alone.
  const auto some = outcomes([](const Setting& s) { return s.w == 5 && s.tau == 200 ? 0.0 : s.tau; });
  EXPECT_EQ(rising_with_tau(some, rmse), 12);
  EXPECT_EQ(distinct(outcomes([](const Setting& s) { return s.tau + 1000 * s.w; }), rmse), 9U);
  auto all = outcomes([](const Setting& s) { return s.k; });
  all[0].rmse = kInfinite;
  EXPECT_EQ(distinct(all, rmse), 6U);
}

TEST(DrillAnalysis, RecordsSharesOfGoodSetsAndSetsAboveOne) {
  // 18 sets at 0.02, 18 at 0.026 and 18 at 1.5: no outliers.
  auto all = outcomes([](const Setting& s) { return s.tau == 25 ? 0.02 : s.tau == 100 ? 0.026 : 1.5; });
  Record record;
  Recorder recorder(record, "out");
  record_error(all, "x_", rmse, recorder);
  EXPECT_EQ(value(record, "x_least"), 0.02);
  EXPECT_EQ(value(record, "x_sets_in_range"), 18);
  EXPECT_DOUBLE_EQ(value(record, "x_good_in_range"), 1.0 / 3);
  EXPECT_EQ(value(record, "x_sets_above_1"), 18);
  EXPECT_EQ(value(record, "x_cases_rising_with_tau"), 18);
  EXPECT_FALSE(gives_all(all, rmse));
  for (Outcome& o : all) o.rmse = o.rmse == 0.026 ? 0.021 : o.rmse;
  EXPECT_TRUE(gives_all(all, rmse));
  // Nothing else where an error is infinite.
  all[7].rmse = kInfinite;
  Record other;
  Recorder infinite(other, "out");
  record_error(all, "", rmse, infinite);
  add_share(infinite, "share", all[7].rmse);
  ASSERT_EQ(other.metrics.size(), 1U);
  EXPECT_EQ(value(other, "infinite_sets"), 1);
}

TEST(DrillFactorial, ReadsEquationThreeInTwelveWays) {
  static_assert(kReadings[reading("mean-plane")].space == ChannelSpace::kPlane && reading("sum-plane") == 8);
  const Heightfield ground = crop(noise_hills(90, 3), 0, 0, 90, 70);
  for (const Variant& variant : kVariants) {
    const FlowNetwork network = variant.route(ground);
    const Setting setting{25, 5, 6};
    const Drills drills = extract_drills(ground, network, options_for(setting, variant));
    const Heightfield regenerated = regenerate(drills);
    const Outcome outcome = compare(ground, network, drills, regenerated, setting, variant);
    for (std::size_t r = 0; r < kReadings.size(); ++r) {
      const ChannelDistance distance =
          channel_distance(ground, channel_pixels(network, 25), regenerated,
                           channel_pixels(variant.route(regenerated), 25), kReadings[r].space);
      EXPECT_EQ(outcome.ahd[r], distance.normalised(kReadings[r].average)) << kReadings[r].name;
    }
    std::size_t plateau = 0;
    for (const float h : regenerated.heights) plateau += h >= height_range(ground).highest;
    EXPECT_DOUBLE_EQ(outcome.untouched, static_cast<double>(plateau) / (90 * 70));
    EXPECT_EQ(outcome.drills, channel_pixels(network, 25).size());
  }
}

// A sweep with the RMSE that `error` gives.
template <class Error>
Sweep swept(const Error& error) {
  Sweep sweep;
  for (std::size_t t = 0; t < kTaus.size(); ++t) {
    for (std::size_t w = 0; w < kSweptWidths.size(); ++w) {
      for (int k = kLeastK; k <= kMostK; ++k) {
        sweep.rmse[t][w][static_cast<std::size_t>(k - kLeastK)] =
            error(Setting{kTaus[t], kSweptWidths[w], k});
      }
    }
  }
  return sweep;
}

TEST(DrillSweep, LevelsAreThoseThatThePaperAllows) {
  const std::vector<Levels> all = allowed_levels();
  // 16 · 15 / 2 pairs of widths beside 10, and the series of six influences in 2 … 40 that hold 20.
  int series = 0;
  for (int step = 1; step <= 7; ++step) {
    for (int place = 0; place < 6; ++place) series += 20 - place * step >= 2 && 20 + (5 - place) * step <= 40;
  }
  EXPECT_EQ(all.size(), 120U * static_cast<std::size_t>(series));
  for (const Levels& levels : all) {
    EXPECT_TRUE(std::ranges::count(levels.influences, 20) == 1 && std::ranges::is_sorted(levels.influences));
    EXPECT_EQ(std::set(levels.widths.begin(), levels.widths.end()).size(), 3U);
  }
}

TEST(DrillSweep, CountsTheFactorialsInWhichStatementsHold) {
  const auto bowl = [](const Setting& s) { return std::abs(s.w - 10) + std::abs(s.k - 20) + 0.001 * s.tau; };
  const Held best = held(swept(bowl));
  EXPECT_EQ(best.best, best.all);
  EXPECT_EQ(best.every_case, best.all);
  EXPECT_EQ(best.tau_first, 0);
  const Held tau = held(swept([](const Setting& s) { return 100.0 * s.tau + s.w + s.k; }));
  EXPECT_EQ(tau.tau_first, tau.all);
  // The least w and k are the best: those of 66 of the 120 pairs of widths, and of 4 of the 28 series.
  EXPECT_EQ(tau.best_width, 66 * 28);
  EXPECT_EQ(tau.best, 66 * 4);
  EXPECT_EQ(held(swept([](const Setting& s) { return 1.0 / s.tau; })).every_case, 0);
}

TEST(DrillSweep, AgreesWithTheFactorial) {
  const TerrainSource source = source_of("hills", crop(noise_hills(70, 3), 0, 0, 60, 50));
  Progress progress;
  const Sweep all = sweep(*source.heights, kVariants[2].route(*source.heights), kVariants[2], progress);
  for (const Outcome& o : factorial_of(source, kVariants[2], progress)) {
    const auto w = std::ranges::find(kSweptWidths, o.setting.w) - kSweptWidths.begin();
    const auto t = std::ranges::find(kTaus, o.setting.tau) - kTaus.begin();
    EXPECT_EQ(all.at(static_cast<std::size_t>(t), static_cast<std::size_t>(w), o.setting.k), o.rmse);
  }
}

// Of one drill that rises by 2 m per sample in a window of 2k + 1 samples on a plateau.
EdgeSteps steps_of_one_drill(float plateau, int k, Heightfield* terrain = nullptr) {
  Drills drills;
  drills.width = drills.depth = 9;
  drills.plateau = plateau;
  drills.k = k;
  drills.pixel = {40};  // the centre
  drills.direction = {FlowNetwork::kOutlet};
  drills.elevation = {50};
  drills.slope = {2};
  drills.curvature = {0};
  if (terrain != nullptr) *terrain = regenerate(drills);
  return edge_steps(drills, drill_one_by_one(drills, as_listed(drills)));
}

TEST(DrillEdges, AreWhereAWindowEnds) {
  Heightfield terrain;
  const EdgeSteps edges = steps_of_one_drill(100, 2, &terrain);
  EXPECT_EQ(edges.across.pairs, 20U);  // 5 per side
  EXPECT_EQ(edges.across.pairs + edges.inside.pairs, 2U * 9 * 8);
  EXPECT_FLOAT_EQ(static_cast<float>(edges.across.largest), 46);  // beside the middle of a side
  EXPECT_FLOAT_EQ(static_cast<float>(edges.inside.largest), 2);
  EXPECT_EQ(edges.across.largest, steps(terrain).largest);
  EXPECT_GT(steps_of_one_drill(200, 2).across.largest, edges.across.largest + 99);
  EXPECT_EQ(steps_of_one_drill(200, 8).across.pairs, 0U);  // the window covers all: no border
}

TEST(DrillGround, NoiseIsWholeMetresAndItsSeeds) {
  for (const char* const name : {"noise-ridges", "noise-hills"}) {
    const TerrainSource one = open_ground(name, 1), again = open_ground(name, 1), two = open_ground(name, 2);
    ASSERT_TRUE(one.heights);
    EXPECT_EQ(one.heights->width, 400);
    for (const float h : one.heights->heights) ASSERT_EQ(h, std::floor(h));
    EXPECT_EQ(one.checksum, again.checksum);
    EXPECT_NE(one.checksum, two.checksum);
  }
}

TEST(DrillGround, LargerHillsContinueSmallerOnes) {
  const Heightfield small = noise_hills(96, 7), large = noise_hills(150, 7);
  for (int j = 0; j < 96; ++j) {
    for (int i = 0; i < 96; ++i) ASSERT_EQ(small.at(i, j), large.at(i, j)) << i << " " << j;
  }
  EXPECT_EQ(open_ground("noise-hills", 7).heights->heights, whole_metres(noise_hills(400, 7)).heights);
}

// Relative luminance (WCAG 2) with all cones, and without the red or the green ones (Viénot, Brettel & Mollon
// 1999, in linear RGB).
enum class Eyes { kAll, kProtan, kDeutan };

double luminance(const Rgb& colour, Eyes eyes) {
  double c[3];
  for (int i = 0; i < 3; ++i) {
    const double v = colour[i] / 255.0;
    c[i] = v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
  }
  if (eyes != Eyes::kAll) {
    const double red_green =
        eyes == Eyes::kProtan ? 0.11238 * c[0] + 0.88762 * c[1] : 0.29275 * c[0] + 0.70725 * c[1];
    const double blue =
        eyes == Eyes::kProtan ? 0.00401 * (c[0] - c[1]) + c[2] : -0.02234 * (c[0] - c[1]) + c[2];
    c[0] = c[1] = red_green;
    c[2] = blue;
  }
  return 0.2126 * c[0] + 0.7152 * c[1] + 0.0722 * c[2];
}

// As the caption of figure 1 says.
TEST(DrillColours, TheHighestIsWhiteThenBrownGreenAndBlue) {
  EXPECT_EQ(figures::elevation_colour(1), (Rgb{255, 255, 255}));
  const Rgb brown = figures::elevation_colour(2.0 / 3), green = figures::elevation_colour(1.0 / 3),
            blue = figures::elevation_colour(0);
  EXPECT_TRUE(brown[0] > brown[1] && brown[1] > brown[2]);
  EXPECT_TRUE(green[1] > green[0] && green[1] > green[2]);
  EXPECT_TRUE(blue[2] > blue[1] && blue[1] > blue[0]);
}

TEST(DrillColours, ChannelsStandOutOnEveryElevationForAllEyes) {
  for (const Eyes eyes : {Eyes::kAll, Eyes::kProtan, Eyes::kDeutan}) {
    for (double t = 0; t <= 1; t += 0.05) {
      const double ground = luminance(figures::elevation_colour(t), eyes),
                   water = luminance(figures::kChannel, eyes);
      EXPECT_GE((ground + 0.05) / (water + 0.05), 2.5) << t;  // for thin lines in full light
    }
  }
}

TEST(DrillColours, ErrorsGrowDarkerOrRedderAndInkIsLegible) {
  for (double t = 0; t <= 1; t += 0.02) {
    const Rgb colour = figures::error_colour(t);
    const double paper = luminance(colour, Eyes::kAll), ink = luminance(figures::ink_on(colour), Eyes::kAll);
    EXPECT_GE((std::max(paper, ink) + 0.05) / (std::min(paper, ink) + 0.05), 4.5) << t;
  }
  EXPECT_EQ(figures::difference_colour(0.5), (Rgb{250, 250, 250}));
  EXPECT_EQ(figures::direction_colour(0), figures::direction_colour(1));
}

TEST(DrillColours, LightIsEvenOnFlatGroundAndComesFromTheNorthWest) {
  Heightfield field;
  field.width = field.depth = 5;
  field.heights.assign(25, 7.0F);
  const figures::Light flat(field);
  for (int j = 0; j < 5; ++j) {
    for (int i = 0; i < 5; ++i) EXPECT_NEAR(flat.at(i, j), std::sqrt(0.5), 1e-3);
  }
  for (int j = 0; j < 5; ++j) {
    for (int i = 0; i < 5; ++i) field.at(i, j) = static_cast<float>(i + j);  // faces north-west
  }
  const figures::Light slope(field);
  EXPECT_GT(slope.at(2, 2), std::sqrt(0.5) + 0.1);
  for (float& h : field.heights) h = -h;
  EXPECT_LT(figures::Light(field).at(2, 2), std::sqrt(0.5) - 0.1);
}

}  // namespace
}  // namespace terrabench::drill
