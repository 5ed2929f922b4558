// Medians of raw samples with 95 % intervals, and the rule by which two measured quantities are compared.
//
// Independent samples, such as a time measured six times: the interval of one median lies between two of the
// sorted samples and holds the true median with a probability of 95 % or more, whatever the distribution (the
// sign test; Conover 1999, ch. 3). That of a ratio of two medians is a percentile bootstrap (Efron &
// Tibshirani 1993, ch. 13), which covers 96 % from six samples each on. Samples that were taken in turn are
// drawn in pairs, since a slow period of the machine affects both: 94 %, and where the machine's speed varies
// by a tenth, an interval half as wide.
// A series, such as a time per frame along a flight: consecutive samples resemble each other, and drawn one
// by one they would give an interval that is far too narrow. Blocks of consecutive samples are drawn instead
// (the moving-block bootstrap; Künsch 1989), as long as the series' own dependence asks for (Politis & White
// 2004). For the ratio of two series of one length the same blocks are drawn from both: frame k of two
// methods shows the same view. With 276 frames, the interval covers about 93 % if neighbours correlate by
// 0.5, 88 % by 0.8 and less above: a short series of a slow flight holds few views that differ.
// Deterministic: the resampling has a fixed seed. O(n log n) for a median, O(resamples · n) otherwise.
#pragma once

#include <cstddef>
#include <span>
#include <string_view>

namespace terrabench {

// low, high: the 95 % interval of the median; both are the median where there are fewer than kFewestSamples.
struct Summary {
  std::size_t count = 0;
  double median = 0, low = 0, high = 0;
};
// With fewer, no two samples enclose the median with a probability of 95 %: the range of n encloses it with
// 1 - 2 / 2^n, which is 94 % for five and 97 % for six.
inline constexpr std::size_t kFewestSamples = 6;

// How samples depend on each other, in the order taken.
enum class Order { kIndependent, kSeries };

double median(std::span<const double> samples);  // at least one sample, all finite
// At least one sample, all finite.
Summary summarise(std::span<const double> samples, Order = Order::kIndependent);

// median(numerator) / median(denominator) with its 95 % interval; `count` is the smaller of both. Both need
// samples; a denominator that can be zero gives infinities or NaN, which lie in no range. `in_turn`: samples
// k of both were taken one after the other. Those of different number are drawn apart.
Summary summarise_ratio(std::span<const double> numerator, std::span<const double> denominator,
                        Order = Order::kIndependent, bool in_turn = false);

// The value with three significant digits; and as it is printed: so, if it varies from run to run and is no
// count.
double three_digits(double);
Summary three_digits(const Summary&);
double printed(double value, bool timed);

// Two quantities that differ by less count as equal. Times and rates: of the ranked medians, two thirds
// differed by less between two runs of the whole paper profile on one machine, which the interval of one run
// does not cover. All else, such as bytes, triangles and errors, is exact, but a smaller lead is no reason to
// choose a method: stacks take 0.2 % fewer bytes than the implicit surface that is built on them. The best
// file of a search: two searches with different seeds differ by as much.
inline constexpr double kTimingMargin = 1.25, kExactMargin = 1.01, kSearchMargin = 1.1;
inline double margin_of(bool timed) { return timed ? kTimingMargin : kExactMargin; }

// What a ratio a ÷ b of two measured quantities shows.
enum class Relation {
  kMore,       // a is larger: the ratio is at least the margin, and its whole interval lies above 1
  kLess,       // smaller: so is b ÷ a
  kTied,       // the whole interval lies within the margin, on both sides of 1
  kUndecided,  // none of these; or a time that was sampled fewer than kFewestSamples times
};
// The one rule by which rankings, comparisons of runs and claims about the order of times decide. The figures
// are rounded to three digits first, so that what is printed never contradicts it.
Relation relation(const Summary& ratio, bool timed, double margin);
inline Relation relation(const Summary& ratio, bool timed) {
  return relation(ratio, timed, margin_of(timed));
}

// Whether a quantity of this unit varies from run to run (times, rates); all others are exact.
bool is_timing(std::string_view unit);

}  // namespace terrabench
