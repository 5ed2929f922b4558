// Channels, cross-sections, their union and the fit, against plain double-precision readings of §2.2.
#include <functional>
#include <optional>

#include "representations/drill/cross_sections.h"
#include "representations/drill/extract.h"
#include "representations/drill/profile_fit.h"
#include "tests/representations/drill_ground.h"
#include "tests/terrain/errors.h"

namespace terrabench::test {
namespace {

// Bilinear in double; nothing when a sample that carries weight is missing.
std::optional<double> bilinear(const Heightfield& field, double x, double z) {
  const auto settle = [](double v) { return std::abs(v - std::round(v)) < 1e-6 ? std::round(v) : v; };
  x = settle(x);
  z = settle(z);
  const int i = static_cast<int>(std::floor(x)), j = static_cast<int>(std::floor(z));
  double sum = 0;
  for (int dj = 0; dj < 2; ++dj) {
    for (int di = 0; di < 2; ++di) {
      const double weight = (di == 1 ? x - i : 1 - (x - i)) * (dj == 1 ? z - j : 1 - (z - j));
      if (weight == 0) continue;
      if (i + di < 0 || j + dj < 0 || i + di >= field.width || j + dj >= field.depth) return std::nullopt;
      const float h = field.at(i + di, j + dj);
      if (std::isnan(h)) return std::nullopt;
      sum += weight * h;
    }
  }
  return sum;
}

std::optional<double> highest(const Heightfield& field, int x, int z, int distance) {
  std::optional<double> best;
  for (int ray = 0; ray < 120; ++ray) {
    const double angle = ray * 3 * std::numbers::pi / 180;
    const auto h = bilinear(field, x + distance * std::cos(angle), z + distance * std::sin(angle));
    if (h && (!best || *h > *best)) best = h;
  }
  return best;
}

double squared_error(const std::vector<std::pair<double, double>>& samples, double a, double b) {
  double sum = 0;
  for (const auto& [r, y] : samples) sum += std::pow(a * r + b * r * r - y, 2);
  return sum;
}

// The least error under the bounds, by nested ternary search: the error is convex in both unknowns.
double least_error(const std::vector<std::pair<double, double>>& samples, DrillFit fit) {
  const auto search = [](double low, double high, const std::function<double(double)>& f) {
    for (int i = 0; i < 200; ++i) {
      const double p = low + (high - low) / 3, q = high - (high - low) / 3;
      (f(p) < f(q) ? high : low) = f(p) < f(q) ? q : p;
    }
    return f(low);
  };
  constexpr double kFar = 3000;
  const bool monotone = fit == DrillFit::kMonotone;
  return search(monotone ? 0 : -kFar, kFar, [&](double b) {
    if (fit == DrillFit::kVertex) return squared_error(samples, 0, b);
    return search(monotone ? 0 : -kFar * 20, kFar * 20,
                  [&](double a) { return squared_error(samples, a, b); });
  });
}

TEST(CrossSections, UnionsAreTheHighestOfAllRays) {
  for (const unsigned holes : {0U, 3U, 30U}) {
    const Heightfield field = hills(41, 33, 5 + holes, false, holes);
    for (const int w : {1, 4, 13, 41}) {
      const CrossSections sections(field, w);
      std::vector<float> joined(static_cast<std::size_t>(w));
      for (std::uint32_t pixel = 0; pixel < field.heights.size(); pixel += 37) {
        sections.join(pixel, joined);
        for (int r = 1; r <= w; ++r) {
          const auto expected = highest(field, static_cast<int>(pixel) % 41, static_cast<int>(pixel) / 41, r);
          const float got = joined[static_cast<std::size_t>(r) - 1];
          ASSERT_EQ(CrossSections::is_sample(got), expected.has_value()) << pixel << " at " << r;
          if (!expected) continue;
          ASSERT_NEAR(got, *expected, 2e-2);  // positions within 10⁻⁴ of a grid line are put on it
        }
      }
    }
  }
}

TEST(CrossSections, RaysAreThoseThatTheUnionTakesTheMaximumOf) {
  const Heightfield field = hills(30, 30, 3);
  const CrossSections sections(field, 9);
  std::vector<float> rays(CrossSections::kRays * 9), joined(9);
  for (const std::uint32_t pixel : {0U, 465U, 899U, 31U}) {
    sections.rays(pixel, rays);
    sections.join(pixel, joined);
    for (std::size_t r = 0; r < 9; ++r) {
      float most = CrossSections::kNothing;
      for (std::size_t ray = 0; ray < CrossSections::kRays; ++ray) most = std::max(most, rays[ray * 9 + r]);
      if (CrossSections::is_sample(joined[r])) {
        EXPECT_EQ(most, joined[r]);
      }
    }
  }
}

TEST(ProfileFit, IsTheLeastSquaresUnderItsBounds) {
  std::mt19937 random(7);
  std::normal_distribution<double> normal(0, 1);
  for (int round = 0; round < 60; ++round) {
    const std::size_t w = 2 + random() % 14;
    const double a = 20 * normal(random), b = 2 * normal(random);
    std::vector<float> joined(w);
    std::vector<std::pair<double, double>> samples;
    for (std::size_t i = 0; i < w; ++i) {
      const double r = static_cast<double>(i + 1);
      joined[i] = static_cast<float>(300 + a * r + b * r * r + 3 * normal(random));
      if (random() % 8 == 0) joined[i] = CrossSections::kNothing;
      if (CrossSections::is_sample(joined[i])) samples.emplace_back(r, joined[i] - 300.0);
    }
    if (samples.size() < 2) continue;
    for (const DrillFit fit_to : {DrillFit::kPrinted, DrillFit::kVertex, DrillFit::kMonotone}) {
      const FittedProfile fit = fit_profile(joined, 300, fit_to);
      ASSERT_TRUE(fit.determined);
      const double error = squared_error(samples, fit.slope, fit.curvature);
      const double expected = least_error(samples, fit_to);
      EXPECT_NEAR(error, expected, 1e-3 * (1 + expected))
          << "fit " << static_cast<int>(fit_to) << ", w " << w;
      if (fit_to == DrillFit::kVertex) {
        EXPECT_EQ(fit.slope, 0);
      }
      if (fit_to == DrillFit::kMonotone) {
        EXPECT_GE(std::min(fit.slope, fit.curvature), 0);
      }
    }
  }
}

TEST(ProfileFit, FollowsAnExactParabola) {
  std::vector<float> joined;
  for (int r = 1; r <= 10; ++r) joined.push_back(static_cast<float>(100 + 4 * r + 0.5 * r * r));
  for (const DrillFit fit_to : {DrillFit::kPrinted, DrillFit::kMonotone}) {
    const FittedProfile fit = fit_profile(joined, 100, fit_to);
    EXPECT_NEAR(fit.slope, 4, 1e-4);
    EXPECT_NEAR(fit.curvature, 0.5, 1e-5);
  }
  for (int r = 1; r <= 10; ++r)
    joined[static_cast<std::size_t>(r) - 1] = 100 + 0.75F * static_cast<float>(r * r);
  const FittedProfile vertex = fit_profile(joined, 100, DrillFit::kVertex);
  EXPECT_EQ(vertex.slope, 0);
  EXPECT_FLOAT_EQ(vertex.curvature, 0.75F);
}

TEST(ProfileFit, OfOneSampleIsALineAndOfNoneIsUndetermined) {
  const std::vector<float> one = {CrossSections::kNothing, 130}, none(4, CrossSections::kNothing);
  const FittedProfile line = fit_profile(one, 100, DrillFit::kMonotone);
  EXPECT_FLOAT_EQ(line.slope, 15);
  EXPECT_EQ(line.curvature, 0);
  EXPECT_FALSE(fit_profile(none, 100, DrillFit::kMonotone).determined);
  EXPECT_FLOAT_EQ(fit_profile(one, 100, DrillFit::kVertex).curvature, 7.5F);
}

TEST(Extraction, DrillsAreTheChannelsInRowMajorOrder) {
  const Heightfield field = hills(60, 50, 1);
  const FlowNetwork network = route_flow(field);
  for (const std::uint32_t tau : {1U, 5U, 25U, 300U}) {
    DrillOptions options;
    options.tau = tau;
    const Drills drills = extract_drills(field, network, options);
    std::vector<std::uint32_t> expected;
    for (std::uint32_t i = 0; i < field.heights.size(); ++i) {
      if (network.accumulation[i] >= tau) expected.push_back(i);
    }
    EXPECT_EQ(drills.pixel, expected);
    for (std::size_t i = 0; i < drills.count(); ++i) {
      EXPECT_EQ(drills.elevation[i], field.heights[drills.pixel[i]]);
      EXPECT_EQ(drills.direction[i], network.direction[drills.pixel[i]]);
    }
  }
}

TEST(Extraction, WithoutEnoughFlowThereIsNoDrill) {
  DrillOptions options;
  options.tau = 1000000;
  const Drills drills = drill(hills(20, 20, 2), options);
  EXPECT_EQ(drills.count(), 0U);
  EXPECT_GT(drills.plateau, 400);
}

TEST(Extraction, SinglePixelsRowsFlatsAndHolesGiveDrills) {
  DrillOptions options;
  options.tau = 1;
  options.w = 1;
  const Drills one = drill(Heightfield{1, 1, 10, 10, {7}, {}}, options);
  ASSERT_EQ(one.count(), 1U);
  EXPECT_EQ(one.plateau, 7);
  const Drills row = drill(Heightfield{5, 1, 10, 10, {3, 2, 1, 2, 3}, {}}, options);
  EXPECT_EQ(row.count(), 5U);
  EXPECT_EQ(row.slope[2], 1);
  const Drills flat = drill(Heightfield{9, 9, 10, 10, std::vector<float>(81, 4), {}}, options);
  EXPECT_EQ(flat.count(), 81U);
  EXPECT_EQ(*std::max_element(flat.slope.begin(), flat.slope.end()), 0);
  const Drills none =
      drill(Heightfield{3, 3, 1, 1, std::vector<float>(9, Heightfield::kNoData), {}}, options);
  EXPECT_EQ(none.count(), 0U);
  EXPECT_EQ(none.holes, (std::vector<HoleRun>{{0, 9}}));
}

TEST(Extraction, ADrillThatSeesNothingDigsItsOwnPixelOnly) {
  Heightfield field{7, 7, 1, 1, std::vector<float>(49, Heightfield::kNoData), {}};
  field.at(3, 3) = 10;
  field.at(0, 0) = 50;
  DrillOptions options;
  options.tau = 1;
  options.w = 2;
  const Drills drills = drill(field, options);
  ASSERT_EQ(drills.count(), 2U);
  EXPECT_EQ(drills.slope[1], 40);
  EXPECT_EQ(drills.curvature[1], 0);
}

TEST(Extraction, MonotoneProfilesNeverRiseDownstreamAndOnlyLower) {
  const Heightfield field = hills(80, 70, 4, true);
  DrillOptions options;
  options.tau = 8;
  const Drills plain = drill(field, options);
  options.monotone_profiles = true;
  const Drills drills = drill(field, options);
  std::size_t lowered = 0;
  for (std::size_t i = 0; i < drills.count(); ++i) {
    EXPECT_LE(drills.elevation[i], plain.elevation[i]);
    lowered += drills.elevation[i] < plain.elevation[i] ? 1 : 0;
    if (drills.direction[i] == FlowNetwork::kOutlet) continue;
    const FlowStep step = kFlowSteps[drills.direction[i]];
    const auto below = std::lower_bound(drills.pixel.begin(), drills.pixel.end(),
                                        drills.pixel[i] + static_cast<std::uint32_t>(step.z * 80 + step.x));
    EXPECT_LE(drills.elevation[static_cast<std::size_t>(below - drills.pixel.begin())], drills.elevation[i]);
  }
  EXPECT_GT(lowered, 0U);
}

TEST(Extraction, IsTheSameForAnyThreadsAndInstructionSet) {
  const Heightfield field = hills(70, 90, 8, false, 2);
  DrillOptions options;
  options.tau = 4;
  options.adaptive_k = true;
  const Drills many = drill(field, options);
  with_any_threads_and_targets([&] { EXPECT_TRUE(drill(field, options) == many); });
}

TEST(Extraction, RefusesOptionsThatMakeNoSense) {
  const Heightfield field = hills(20, 12, 1);
  const FlowNetwork network = route_flow(field);
  const auto fails = [&](const auto& change) {
    DrillOptions options;
    change(options);
    const Failure failure = failure_of([&] { extract_drills(field, network, options); });
    return failure.code == ExitCode::kUsage && !failure.advice.empty();
  };
  EXPECT_TRUE(fails([](DrillOptions& o) { o.tau = 0; }));
  EXPECT_TRUE(fails([](DrillOptions& o) { o.w = 0; }));
  EXPECT_TRUE(fails([](DrillOptions& o) { o.w = -4; }));
  EXPECT_TRUE(fails([](DrillOptions& o) { o.w = 21; }));
  EXPECT_TRUE(fails([](DrillOptions& o) { o.k = -1; }));
  EXPECT_TRUE(fails([](DrillOptions& o) { o.k = 256; }));
  DrillOptions longest;
  longest.w = 255;
  check_options(longest, 8000000, 2);
  EXPECT_EQ(failure_of([&] { check_options(longest, 1 << 24, 2); }).code, ExitCode::kUsage);
  DrillOptions widest;
  widest.w = 20;
  EXPECT_GT(extract_drills(field, network, widest).count(), 0U);
}

}  // namespace
}  // namespace terrabench::test
