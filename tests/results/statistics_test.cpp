#include "results/store/statistics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

namespace terrabench {
namespace {

TEST(Statistics, OneSampleIsItsOwnInterval) {
  const Summary s = summarise(std::vector{3.5});
  EXPECT_EQ(s.count, 1U);
  EXPECT_EQ(s.median, 3.5);
  EXPECT_EQ(s.low, 3.5);
  EXPECT_EQ(s.high, 3.5);
}

TEST(Statistics, MedianOfOddAndEvenCountsInAnyOrder) {
  EXPECT_EQ(summarise(std::vector{9.0, 1.0, 4.0}).median, 4.0);
  EXPECT_EQ(summarise(std::vector{9.0, 1.0, 4.0, 6.0}).median, 5.0);
}

TEST(Statistics, IntervalHoldsTheMedianAndIgnoresOneOutlier) {
  const Summary s = summarise(std::vector{1.0, 1.01, 0.99, 1.02, 0.98, 1.0, 1.01, 0.99, 50.0});
  EXPECT_LE(s.low, s.median);
  EXPECT_GE(s.high, s.median);
  EXPECT_LT(s.high, 1.1);
  EXPECT_GE(s.low, 0.98);
}

TEST(Statistics, RepeatsToTheBit) {
  const std::vector samples{1.0, 2.0, 3.0, 4.0, 5.0, 6.0};
  const Summary a = summarise(samples), b = summarise(samples);
  EXPECT_EQ(a.low, b.low);
  EXPECT_EQ(a.high, b.high);
}

// Theory for the median of n uniform samples: 0.5 ± 1.96 / (2 √n). The count lies above the direct draw's
// limit.
TEST(Statistics, ManySamplesFollowTheory) {
  std::mt19937_64 random(7);
  std::vector<double> samples(10'000);
  for (double& sample : samples) sample = static_cast<double>(random() >> 11) * 0x1p-53;
  const Summary s = summarise(samples);
  EXPECT_NEAR(s.high - s.low, 2 * 1.96 / (2 * 100), 0.004);
  EXPECT_NEAR(s.median, 0.5, 0.02);
}

TEST(Statistics, RatioOfMedians) {
  const std::vector fast{1.0, 1.1, 0.9, 1.0, 1.05}, slow{8.0, 8.1, 7.9, 8.0, 8.05};
  const Summary ratio = summarise_ratio(slow, fast);
  EXPECT_EQ(ratio.median, 8.0);
  EXPECT_GT(ratio.low, 7.0);
  EXPECT_LT(ratio.high, 9.0);
  EXPECT_LT(ratio.low, ratio.high);
}

TEST(Statistics, RatioToZeroIsInfiniteOrNotANumber) {
  EXPECT_TRUE(std::isinf(summarise_ratio(std::vector{1.0}, std::vector{0.0}).median));
  const Summary none = summarise_ratio(std::vector{0.0, 0.0}, std::vector{0.0, 0.0});
  EXPECT_TRUE(std::isnan(none.median));
  EXPECT_TRUE(std::isnan(none.low));
}

TEST(Statistics, TimesAndRatesVary) {
  for (const char* unit : {"s", "ms", "1/s", "B/s", "Hz"}) EXPECT_TRUE(is_timing(unit)) << unit;
  for (const char* unit : {"", "B", "m", "m³", "samples"}) EXPECT_FALSE(is_timing(unit)) << unit;
}

}  // namespace
}  // namespace terrabench
