#include "results/store/statistics.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <numeric>
#include <vector>

#include "terrain/splitmix.h"

namespace terrabench {
namespace {

constexpr int kResamples = 2000;
constexpr std::uint64_t kSeed = 20240229;  // the same interval for the same samples, on every machine

// Reorders the values.
double median_in_place(std::span<double> values) {
  const std::size_t n = values.size();
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(n / 2);
  std::nth_element(values.begin(), middle, values.end());
  return n % 2 == 1 ? *middle : std::midpoint(*std::max_element(values.begin(), middle), *middle);
}

// Autocovariances of the signs of the samples' differences from their median. The error of a median is to
// first order a mean of these signs.
std::vector<double> sign_covariances(std::span<const double> samples, std::size_t most) {
  const std::size_t n = samples.size();
  const double middle = median(samples);
  std::vector<double> signs(n), covariances(std::min(most, n - 1) + 1);
  for (std::size_t i = 0; i < n; ++i) signs[i] = samples[i] > middle ? 1 : samples[i] < middle ? -1 : 0;
  const double mean = std::accumulate(signs.begin(), signs.end(), 0.0) / static_cast<double>(n);
  for (double& sign : signs) sign -= mean;
  for (std::size_t k = 0; k < covariances.size(); ++k) {
    covariances[k] =
        std::inner_product(signs.begin() + static_cast<std::ptrdiff_t>(k), signs.end(), signs.begin(), 0.0) /
        static_cast<double>(n);
  }
  return covariances;
}

// The automatic choice of Politis & White (2004, section 3.2), of the signs' autocovariances: the smallest
// lag after which kQuiet correlations in a row are insignificant ends the flat part of a flat-top window, and
// the windowed sums give the length that makes the error of the estimated variance least.
std::size_t block_length(std::span<const double> series) {
  constexpr std::size_t kQuiet = 5;
  const auto n = static_cast<double>(series.size());
  const auto farthest = static_cast<std::size_t>(std::ceil(std::sqrt(n))) + kQuiet;
  const std::vector<double> r = sign_covariances(series, 2 * farthest);
  const double significant = 2 * std::sqrt(std::log10(n) / n) * r[0];
  std::size_t last = 0;  // lag with a significant correlation
  for (std::size_t k = 1; k < r.size() && k <= std::min(last + kQuiet, farthest); ++k) {
    if (std::abs(r[k]) >= significant) last = k;
  }
  const std::size_t window = std::min(2 * std::max<std::size_t>(last, 1), r.size() - 1);
  double spectrum = r[0], slope = 0;
  for (std::size_t k = 1; k <= window; ++k) {
    const double share = static_cast<double>(k) / static_cast<double>(window);
    const double weight = 2 * std::min(1.0, 2 * (1 - share)) * r[k];
    spectrum += weight;
    slope += weight * static_cast<double>(k);
  }
  const double length = std::ceil(std::cbrt(1.5 * n * slope * slope / (spectrum * spectrum)));
  const double most = std::ceil(std::min(3 * std::sqrt(n), n / 3));
  return length <= most ? static_cast<std::size_t>(std::max(length, 1.0)) : static_cast<std::size_t>(most);
}

// Medians of blocks drawn with replacement, which together are as long as the samples.
class Resampler {
 public:
  Resampler(std::span<const double> samples, std::size_t block)
      : samples_(samples), block_(block), drawn_(samples.size()) {}

  double draw(SplitMix& random) {
    const std::size_t n = samples_.size(), starts = n - block_ + 1;
    for (std::size_t at = 0; at < n; at += block_) {
      const auto begin = samples_.begin() + static_cast<std::ptrdiff_t>(random.next() % starts);
      std::copy_n(begin, std::min(block_, n - at), drawn_.begin() + static_cast<std::ptrdiff_t>(at));
    }
    return median_in_place(drawn_);
  }

 private:
  std::span<const double> samples_;
  std::size_t block_;
  std::vector<double> drawn_;
};

Summary with_interval(Summary found, std::vector<double>& draws) {
  std::sort(draws.begin(), draws.end());
  const auto at = [&](double share) { return draws[static_cast<std::size_t>(share * (kResamples - 1))]; };
  found.low = at(0.025);
  found.high = at(0.975);
  return found;
}

// The k-th sample from either end, for the largest k with which they enclose the median with 95 %: fewer than
// k of n fair coins show heads with a probability of 2.5 % or less.
Summary between_samples(Summary found, std::span<const double> samples) {
  std::vector<double> sorted(samples.begin(), samples.end());
  std::sort(sorted.begin(), sorted.end());
  const auto n = static_cast<double>(sorted.size());
  std::size_t k = 0;
  for (double below = 0; k < sorted.size(); ++k) {
    const auto heads = static_cast<double>(k);
    below += std::exp(std::lgamma(n + 1) - std::lgamma(heads + 1) - std::lgamma(n - heads + 1) -
                      n * std::log(2.0));
    if (below > 0.025) break;
  }
  found.low = sorted[k - 1];
  found.high = sorted[sorted.size() - k];
  return found;
}

}  // namespace

double median(std::span<const double> samples) {
  assert(!samples.empty());
  std::vector<double> values(samples.begin(), samples.end());
  return median_in_place(values);
}

Summary summarise(std::span<const double> samples, Order order) {
  const double middle = median(samples);
  const Summary found{samples.size(), middle, middle, middle};
  if (samples.size() < kFewestSamples) return found;
  if (order == Order::kIndependent) return between_samples(found, samples);
  Resampler resampler(samples, block_length(samples));
  SplitMix random(kSeed);
  std::vector<double> draws(kResamples);
  for (double& draw : draws) draw = resampler.draw(random);
  return with_interval(found, draws);
}

Summary summarise_ratio(std::span<const double> numerator, std::span<const double> denominator, Order order,
                        bool in_turn) {
  const double ratio = median(numerator) / median(denominator);
  const Summary found{std::min(numerator.size(), denominator.size()), ratio, ratio, ratio};
  if (found.count < kFewestSamples || std::isnan(ratio)) return found;
  const bool series = order == Order::kSeries;
  const bool paired = (series || in_turn) && numerator.size() == denominator.size();
  std::size_t of_top = series ? block_length(numerator) : 1,
              of_bottom = series ? block_length(denominator) : 1;
  if (paired) of_top = of_bottom = std::max(of_top, of_bottom);
  Resampler above(numerator, of_top), below(denominator, of_bottom);
  SplitMix random(kSeed);
  std::vector<double> draws(kResamples);
  for (double& draw : draws) {
    SplitMix again = random;  // the same numbers draw the same blocks
    const double top = above.draw(random);
    draw = top / below.draw(paired ? again : random);
    if (std::isnan(draw)) return {found.count, ratio, draw, draw};
  }
  return with_interval(found, draws);
}

double three_digits(double value) { return std::strtod(fmt::format("{:.3g}", value).c_str(), nullptr); }

double printed(double value, bool timed) {
  return timed && value != std::trunc(value) ? three_digits(value) : value;
}

Summary three_digits(const Summary& s) {
  return {s.count, three_digits(s.median), three_digits(s.low), three_digits(s.high)};
}

Relation relation(const Summary& ratio, bool timed, double margin) {
  if (timed && ratio.count < kFewestSamples) return Relation::kUndecided;
  const Summary up = three_digits(ratio),
                down = three_digits({ratio.count, 1 / up.median, 1 / up.high, 1 / up.low});
  if (up.low > 1 && up.median >= margin) return Relation::kMore;
  if (down.low > 1 && down.median >= margin) return Relation::kLess;
  return up.high < margin && down.high < margin ? Relation::kTied : Relation::kUndecided;
}

bool is_timing(std::string_view unit) {
  // "exponent" is the unit of an exponent: the slope of a time's logarithm.
  constexpr std::array<std::string_view, 8> kUnits = {"s",  "ms", "µs",       "us",
                                                      "ns", "Hz", "exponent", "faults"};
  return unit.ends_with("/s") || std::find(kUnits.begin(), kUnits.end(), unit) != kUnits.end();
}

}  // namespace terrabench
