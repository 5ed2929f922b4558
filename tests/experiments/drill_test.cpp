#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "experiments/drill/analysis.h"
#include "experiments/drill/ground.h"
#include "experiments/figures/maps.h"

namespace terrabench::drill {
namespace {

// Outcomes of the 54 settings with the RMSE that `error` gives.
template <class Error>
std::vector<Outcome> outcomes(const Error& error) {
  std::vector<Outcome> all;
  for (const std::uint32_t tau : kTaus) {
    for (const int w : kWidths) {
      for (const int k : kInfluences) {
        Outcome outcome;
        outcome.setting = {tau, w, k};
        outcome.rmse = error(outcome.setting);
        all.push_back(outcome);
      }
    }
  }
  return all;
}

double rmse(const Outcome& outcome) { return outcome.rmse; }

TEST(DrillEffects, OneFactorExplainsAll) {
  const Effects effects = main_effects(outcomes([](const Setting& s) { return 0.5 * s.w; }), rmse);
  EXPECT_NEAR(effects.w, 1, 1e-12);
  EXPECT_NEAR(effects.tau, 0, 1e-12);
  EXPECT_NEAR(effects.k, 0, 1e-12);
  EXPECT_NEAR(effects.interactions, 0, 1e-12);
}

TEST(DrillEffects, SumsOfFactorsShareTheVariance) {
  // Variances of the level means: 2/9 for 0, 1, 1 over three τ; 1 for 0 and 2 over six k.
  const auto all =
      outcomes([](const Setting& s) { return (s.tau > 25 ? 1.0 : 0.0) + (s.k > 15 ? 2.0 : 0.0); });
  const Effects effects = main_effects(all, rmse);
  EXPECT_NEAR(effects.tau, (2.0 / 9) / (2.0 / 9 + 1), 1e-12);
  EXPECT_NEAR(effects.k, 1 / (2.0 / 9 + 1), 1e-12);
  EXPECT_NEAR(effects.interactions, 0, 1e-12);
  EXPECT_NEAR(effects.mean_at_tau[0], 1, 1e-12);
  EXPECT_NEAR(effects.mean_at_tau[2], 2, 1e-12);
}

TEST(DrillEffects, WhatNoFactorExplainsIsInteraction) {
  // The sign changes with τ and with k, so that all level means are equal.
  const auto all = outcomes([](const Setting& s) {
    const double tau = s.tau == 25 ? 1 : s.tau == 100 ? -1 : 0;
    return tau * (s.k > 15 ? 1 : -1);
  });
  EXPECT_NEAR(main_effects(all, rmse).interactions, 1, 1e-12);
}

TEST(DrillEffects, SomeLevelsAloneAndNoVarianceAtAll) {
  auto all = outcomes([](const Setting& s) { return s.k == 5 ? 100.0 : s.tau; });
  all.erase(std::remove_if(all.begin(), all.end(), [](const Outcome& o) { return o.setting.k == 5; }),
            all.end());
  EXPECT_NEAR(main_effects(all, rmse).tau, 1, 1e-12);
  const Effects none = main_effects(outcomes([](const Setting&) { return 3.0; }), rmse);
  EXPECT_EQ(none.tau + none.w + none.k + none.interactions, 0);
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

TEST(DrillGrowth, DoublesTheSideUpToTheProfilesLargest) {
  const Experiment& growth = experiment("drill.growth");
  RunOptions options;
  EXPECT_EQ(growth.cases(options).back().name, "n=1024");
  options.profile = Profile::kPaper;
  const std::vector<Case> cases = growth.cases(options);
  EXPECT_EQ(cases.size(), 6U);
  EXPECT_EQ(cases.back().parameters.integer("n"), 8192);
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
