#include "results/store/power_law.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

namespace terrabench {
namespace {

TEST(PowerLawFit, ExactLawsHaveNoInterval) {
  std::vector<double> x, y;
  for (int k = 7; k <= 13; ++k) {
    x.push_back(std::exp2(2 * k));
    y.push_back(3e-9 * std::pow(x.back(), 1.5));
  }
  const auto law = fit_power_law(x, y);
  ASSERT_TRUE(law);
  EXPECT_NEAR(law->exponent, 1.5, 1e-12);
  EXPECT_NEAR(law->low, 1.5, 1e-6);
  EXPECT_NEAR(law->high, 1.5, 1e-6);
  EXPECT_EQ(law->points, 7U);
}

// By hand: y = 1, 2, 8 at x = 1, 2, 4 in powers of two: u = 0 1 2, v = 0 1 3. Slope 3/2, residuals 1/6, -1/3,
// 1/6, whose squares add up to 1/6; t(1) · √(1/6 / 2).
TEST(PowerLawFit, TheIntervalIsThatOfTheTextbook) {
  const std::vector<double> x = {1, 2, 4}, y = {1, 2, 8};
  const auto law = fit_power_law(x, y);
  ASSERT_TRUE(law);
  EXPECT_NEAR(law->exponent, 1.5, 1e-12);
  EXPECT_NEAR(law->high - 1.5, 12.7062 * std::sqrt(1.0 / 12), 1e-9);
  EXPECT_NEAR(1.5 - law->low, 12.7062 * std::sqrt(1.0 / 12), 1e-9);
}

TEST(PowerLawFit, TwoPointsHaveASlopeAndNoFiniteInterval) {
  const std::vector<double> x = {1, 4}, y = {5, 10};
  const auto law = fit_power_law(x, y);
  ASSERT_TRUE(law);
  EXPECT_NEAR(law->exponent, 0.5, 1e-12);
  EXPECT_TRUE(std::isinf(law->low) && std::isinf(law->high));
}

TEST(PowerLawFit, NeedsTwoSizes) {
  EXPECT_FALSE(fit_power_law({}, {}));
  const std::vector<double> same = {2, 2}, x = {2, 2, 8}, y = {3, 3, 12};
  EXPECT_FALSE(fit_power_law(same, {y.data(), 2}));
  EXPECT_NEAR(fit_power_law(x, y)->exponent, 1, 1e-12);
}

// One point without a logarithm among four with one.
TEST(PowerLawFit, RefusesPointsThatAreNotAboveZero) {
  const std::vector<double> above = {1, 2, 4, 8, 16};
  ASSERT_TRUE(fit_power_law(above, above));
  for (const double bad : {0.0, -1.0, std::nan("")}) {
    std::vector<double> values = above;
    values[2] = bad;
    EXPECT_FALSE(fit_power_law(above, values)) << bad;
    EXPECT_FALSE(fit_power_law(values, above)) << bad;
  }
}

// The interval holds the true exponent in 95 % of all trials, for few and for many sizes: ± 4 standard errors
// of the share.
TEST(PowerLawFit, NinetyFiveOfAHundredIntervalsHoldTheTruth) {
  std::mt19937_64 random(7);
  std::normal_distribution<double> noise(0, 0.2);
  constexpr int kTrials = 4000;
  for (const int sizes : {3, 4, 7, 14}) {
    int held = 0;
    for (int trial = 0; trial < kTrials; ++trial) {
      std::vector<double> x, y;
      for (int k = 0; k < sizes; ++k) {
        x.push_back(std::exp2(14 + 2 * k));
        y.push_back(1e-8 * std::pow(x.back(), 1.1) * std::exp(noise(random)));
      }
      const auto law = fit_power_law(x, y);
      held += law->low <= 1.1 && 1.1 <= law->high ? 1 : 0;
    }
    EXPECT_NEAR(static_cast<double>(held) / kTrials, 0.95, 0.014) << sizes;
  }
}

// Quantiles from a printed table (Abramowitz & Stegun, table 26.10).
TEST(PowerLawFit, StudentsQuantiles) {
  EXPECT_NEAR(student_t(1), 12.706, 1e-3);
  EXPECT_NEAR(student_t(5), 2.571, 1e-3);
  EXPECT_NEAR(student_t(11), 2.201, 1e-3);
  EXPECT_NEAR(student_t(15), 2.131, 1e-3);
  EXPECT_NEAR(student_t(30), 2.042, 1e-3);
  EXPECT_NEAR(student_t(120), 1.980, 1e-3);
}

}  // namespace
}  // namespace terrabench
