// Order statistics of raw samples, with percentile-bootstrap intervals (Efron & Tibshirani 1993, ch. 13).
// Deterministic: the resampling has a fixed seed. O(resamples · n) up to a thousand samples, O(n log n)
// above.
#pragma once

#include <cstddef>
#include <span>
#include <string_view>

namespace terrabench {

// low, high: the 95 % interval of the median; both are the median for one sample.
struct Summary {
  std::size_t count = 0;
  double median = 0, low = 0, high = 0;
};
// With fewer, no interval deserves the name: of two samples against two of the same distribution, one pair
// lies wholly above the other with probability 1/3; of three against three with 1/10.
inline constexpr std::size_t kFewestSamples = 3;

double median(std::span<const double> samples);      // at least one sample, all finite
Summary summarise(std::span<const double> samples);  // at least one sample, all finite

// median(numerator) / median(denominator) with its 95 % interval. Both need samples; a denominator that can
// be zero gives infinities or NaN, which lie in no range.
Summary summarise_ratio(std::span<const double> numerator, std::span<const double> denominator);

// Whether two times with this ratio count as different; every comparison of times uses this rule. They do if
// the interval excludes 1 and the ratio or its inverse is at least kTimingMargin. The margin is needed
// because the interval of one run does not cover the differences between runs on one machine. Of the ranked
// medians, two thirds differed by less between two runs of the whole paper profile.
inline constexpr double kTimingMargin = 1.25;
bool differ(const Summary& ratio, double margin = kTimingMargin);

// Whether a quantity of this unit varies from run to run (times, rates); all others are exact.
bool is_timing(std::string_view unit);

}  // namespace terrabench
