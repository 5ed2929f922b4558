#include "results/store/statistics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
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

TEST(Statistics, FewerThanSixSamplesHaveNoInterval) {
  const std::vector six{9.0, 1.0, 4.0, 6.0, 5.0, 7.0}, five(six.begin(), six.begin() + 5);
  const Summary few = summarise(five), enough = summarise(six);
  EXPECT_EQ(few.low, few.median);
  EXPECT_EQ(few.high, few.median);
  EXPECT_EQ(enough.low, 1) << "the range of six holds the median with 97 %";
  EXPECT_EQ(enough.high, 9);
  const Summary ratio = summarise_ratio(six, five);
  EXPECT_EQ(ratio.count, 5U);
  EXPECT_EQ(ratio.low, ratio.high);
}

TEST(Statistics, IntervalIgnoresOneOutlierOfNine) {
  const Summary s = summarise(std::vector{1.0, 1.01, 0.99, 1.02, 0.98, 1.0, 1.01, 0.99, 50.0});
  EXPECT_EQ(s.low, 0.99);
  EXPECT_EQ(s.high, 1.02);
}

class Normal {
 public:
  explicit Normal(std::uint64_t seed) : random_(seed) {}
  double next() { return normal_(random_); }
  // n samples of unit variance, of which neighbours correlate by phi.
  std::vector<double> series(std::size_t n, double phi) {
    std::vector<double> all{next()};
    while (all.size() < n) all.push_back(phi * all.back() + std::sqrt(1 - phi * phi) * next());
    return all;
  }

 private:
  std::mt19937_64 random_;
  std::normal_distribution<> normal_;
};

bool holds(const Summary& s, double truth) { return s.low <= truth && truth <= s.high; }

TEST(Statistics, IntervalsOfFewSamplesHoldTheTruthAsOftenAsTheySay) {
  constexpr int kRepeats = 1000;
  for (const std::size_t n : {6U, 7U, 12U}) {
    Normal random(n);
    int medians = 0, ratios = 0;
    for (int k = 0; k < kRepeats; ++k) {
      std::vector<double> a = random.series(n, 0), b = random.series(n, 0);
      medians += holds(summarise(a), 0);
      for (std::vector<double>* const times : {&a, &b}) {
        for (double& time : *times) time = std::exp(0.1 * time);
      }
      if (k % 4 == 0) ratios += holds(summarise_ratio(a, b), 1);
    }
    EXPECT_GE(medians, 0.94 * kRepeats) << n;
    EXPECT_GE(ratios, 0.93 * kRepeats / 4) << n;
  }
}

// Frames resemble their neighbours. Samples drawn one by one would give far too narrow an interval.
TEST(Statistics, OnlyBlocksCoverTheMedianOfASeries) {
  constexpr int kSeries = 400;
  Normal random(5);
  int blocks = 0, one_by_one = 0;
  for (int k = 0; k < kSeries; ++k) {
    const std::vector<double> series = random.series(276, 0.5);
    blocks += holds(summarise(series, Order::kSeries), 0);
    one_by_one += holds(summarise(series), 0);
  }
  EXPECT_GE(blocks, 0.9 * kSeries);
  EXPECT_LE(one_by_one, 0.85 * kSeries);
}

// Two methods along one path take longer in the same frames.
TEST(Statistics, SeriesOfOnePathAreResampledInPairs) {
  constexpr int kSeries = 40;
  Normal random(7);
  int held = 0;
  double paired_width = 0, apart_width = 0;
  for (int k = 0; k < kSeries; ++k) {
    const std::vector<double> noise_a = random.series(276, 0.5), noise_b = random.series(276, 0.5);
    std::vector<double> a, b;
    for (std::size_t i = 0; i < noise_a.size(); ++i) {
      const double view = 0.5 * std::sin(0.03 * static_cast<double>(i));
      a.push_back(2 * std::exp(view + 0.05 * noise_a[i]));
      b.push_back(std::exp(view + 0.05 * noise_b[i]));
    }
    const Summary paired = summarise_ratio(a, b, Order::kSeries);
    b.pop_back();  // of another length: frames do not belong together
    const Summary apart = summarise_ratio(a, b, Order::kSeries);
    held += holds(paired, 2);
    paired_width += paired.high - paired.low;
    apart_width += apart.high - apart.low;
  }
  EXPECT_GE(held, 0.9 * kSeries);
  EXPECT_LT(paired_width, 0.3 * apart_width);
}

// A slow period of the machine affects all that takes turns.
TEST(Statistics, SamplesTakenInTurnAreResampledInPairs) {
  constexpr int kRepeats = 300;
  Normal random(9);
  int held = 0;
  double paired_width = 0, apart_width = 0;
  for (int k = 0; k < kRepeats; ++k) {
    std::vector<double> a, b;
    while (a.size() < kFewestSamples) {
      const double machine = std::exp(0.2 * random.next());
      a.push_back(2 * machine * std::exp(0.03 * random.next()));
      b.push_back(machine * std::exp(0.03 * random.next()));
    }
    const Summary paired = summarise_ratio(a, b, Order::kIndependent, true), apart = summarise_ratio(a, b);
    held += holds(paired, 2);
    paired_width += paired.high - paired.low;
    apart_width += apart.high - apart.low;
  }
  EXPECT_GE(held, 0.9 * kRepeats);
  EXPECT_LT(paired_width, 0.5 * apart_width);
}

TEST(Statistics, RepeatsToTheBit) {
  const std::vector samples{1.0, 2.0, 3.0, 4.0, 5.0, 6.0};
  for (const Order order : {Order::kIndependent, Order::kSeries}) {
    const Summary a = summarise_ratio(samples, samples, order), b = summarise_ratio(samples, samples, order);
    EXPECT_EQ(a.low, b.low);
    EXPECT_EQ(a.high, b.high);
    EXPECT_EQ(a.low == 1 && a.high == 1, order == Order::kSeries) << "in pairs, a series is equal to itself";
  }
}

TEST(Statistics, RatioOfMedians) {
  const std::vector fast{1.0, 1.1, 0.9, 1.0, 1.05, 0.95}, slow{8.0, 8.1, 7.9, 8.0, 8.05, 7.95};
  const Summary ratio = summarise_ratio(slow, fast);
  EXPECT_EQ(ratio.median, 8.0);
  EXPECT_GT(ratio.low, 7.0);
  EXPECT_LT(ratio.high, 9.0);
  EXPECT_LT(ratio.low, ratio.high);
}

TEST(Statistics, RatioToZeroIsInfiniteOrNotANumber) {
  EXPECT_TRUE(std::isinf(summarise_ratio(std::vector{1.0}, std::vector{0.0}).median));
  const std::vector zeros(6, 0.0);
  const Summary none = summarise_ratio(zeros, zeros);
  EXPECT_TRUE(std::isnan(none.median));
  EXPECT_TRUE(std::isnan(none.low));
}

Relation relation_of(double median, double low, double high, bool timed = true, std::size_t count = 6) {
  return relation({count, median, low, high}, timed);
}

TEST(Relation, TheIntervalAndTheMarginDecide) {
  EXPECT_EQ(relation_of(1.25, 1.01, 2), Relation::kMore);
  EXPECT_EQ(relation_of(0.8, 0.5, 0.99), Relation::kLess) << "the inverse is 1.25";
  EXPECT_EQ(relation_of(1.1, 0.81, 1.24), Relation::kTied);
  EXPECT_EQ(relation_of(1.1, 0.8, 1.24), Relation::kUndecided) << "may be less by the margin";
  EXPECT_EQ(relation_of(1.5, 0.9, 2), Relation::kUndecided);
  EXPECT_EQ(relation_of(1.24, 1.18, 1.2502), Relation::kUndecided);
  EXPECT_EQ(relation_of(1.01, 1.01, 1.01, false, 1), Relation::kMore) << "exact";
  EXPECT_EQ(relation_of(1.004, 1.004, 1.004, false, 1), Relation::kTied);
  EXPECT_EQ(relation_of(9, 9, 9, true, 5), Relation::kUndecided) << "too few samples";
}

// What would be printed alike is judged alike.
TEST(Relation, FiguresAreRoundedFirst) {
  EXPECT_EQ(three_digits(1.2451), 1.25);
  EXPECT_EQ(printed(1234.5, true), 1230);
  EXPECT_EQ(printed(1234.5, false), 1234.5);
  EXPECT_EQ(printed(12345, true), 12345) << "a count that varies";
  EXPECT_EQ(relation_of(1.2451, 1.2, 1.3), Relation::kMore);
  EXPECT_EQ(relation_of(1.2449, 1.2, 1.3), Relation::kUndecided);
  EXPECT_EQ(relation_of(1.4, 1.004, 1.6), Relation::kUndecided) << "1 [...]";
  EXPECT_EQ(relation_of(1.1, 1, 1.2449), Relation::kTied);
  EXPECT_EQ(relation_of(1.1, 1, 1.2451), Relation::kUndecided);
}

TEST(Statistics, TimesAndRatesVary) {
  for (const char* unit : {"s", "ms", "1/s", "B/s", "Hz"}) EXPECT_TRUE(is_timing(unit)) << unit;
  for (const char* unit : {"", "B", "m", "m³", "samples"}) EXPECT_FALSE(is_timing(unit)) << unit;
}

}  // namespace
}  // namespace terrabench
