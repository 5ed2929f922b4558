#include "results/store/statistics.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <numeric>
#include <vector>

#include "terrain/splitmix.h"

namespace terrabench {
namespace {

constexpr int kResamples = 2000;
// Above this the median's rank is drawn from a normal distribution: the error is far below the interval's
// own.
constexpr std::size_t kDrawEach = 1000;

constexpr std::uint64_t kSeed = 20240229;  // the same interval for the same samples, on every machine

std::vector<double> sorted(std::span<const double> samples) {
  std::vector<double> values(samples.begin(), samples.end());
  std::sort(values.begin(), values.end());
  return values;
}

double median_of_sorted(std::span<const double> values) {
  const std::size_t n = values.size();
  return n % 2 == 1 ? values[n / 2] : std::midpoint(values[n / 2 - 1], values[n / 2]);
}

// Medians of samples drawn with replacement.
class Resampler {
 public:
  explicit Resampler(std::span<const double> samples) : values_(sorted(samples)), ranks_(values_.size()) {}
  double median() const { return median_of_sorted(values_); }

  double draw(SplitMix& random) {
    const std::size_t n = values_.size();
    if (n == 1) return values_[0];
    if (n > kDrawEach) {
      const double normal = std::sqrt(-2 * std::log(1 - unit_of(random.next()))) *
                            std::cos(2 * std::numbers::pi * unit_of(random.next()));
      const double rank = static_cast<double>(n) * (0.5 + normal / (2 * std::sqrt(static_cast<double>(n))));
      return values_[static_cast<std::size_t>(std::clamp(rank, 0.0, static_cast<double>(n - 1)))];
    }
    for (std::size_t& rank : ranks_) rank = random.next() % n;
    const auto middle = ranks_.begin() + static_cast<long>(n / 2);
    std::nth_element(ranks_.begin(), middle, ranks_.end());
    if (n % 2 == 1) return values_[*middle];
    return std::midpoint(values_[*std::max_element(ranks_.begin(), middle)], values_[*middle]);
  }

 private:
  std::vector<double> values_;
  std::vector<std::size_t> ranks_;
};

Summary with_interval(std::size_t count, double median, std::vector<double>& draws) {
  std::sort(draws.begin(), draws.end());
  const auto at = [&](double share) { return draws[static_cast<std::size_t>(share * (kResamples - 1))]; };
  return {count, median, at(0.025), at(0.975)};
}

}  // namespace

double median(std::span<const double> samples) {
  assert(!samples.empty());
  return median_of_sorted(sorted(samples));
}

Summary summarise(std::span<const double> samples) {
  assert(!samples.empty());
  if (samples.size() == 1) return {1, samples[0], samples[0], samples[0]};
  Resampler resampler(samples);
  SplitMix random(kSeed);
  std::vector<double> draws(kResamples);
  for (double& draw : draws) draw = resampler.draw(random);
  return with_interval(samples.size(), resampler.median(), draws);
}

Summary summarise_ratio(std::span<const double> numerator, std::span<const double> denominator) {
  assert(!numerator.empty() && !denominator.empty());
  if (numerator.size() == 1 && denominator.size() == 1) {
    const double ratio = numerator[0] / denominator[0];
    return {1, ratio, ratio, ratio};
  }
  Resampler above(numerator), below(denominator);
  SplitMix random(kSeed);
  std::vector<double> draws(kResamples);
  const double ratio = above.median() / below.median();
  for (double& draw : draws) {
    const double top = above.draw(random);
    draw = top / below.draw(random);
    if (std::isnan(draw)) return {std::min(numerator.size(), denominator.size()), ratio, draw, draw};
  }
  return with_interval(std::min(numerator.size(), denominator.size()), ratio, draws);
}

bool differ(const Summary& ratio, double margin) {
  return (ratio.low > 1 && ratio.median >= margin) || (ratio.high < 1 && ratio.median <= 1 / margin);
}

bool is_timing(std::string_view unit) {
  // "exponent" is the unit of an exponent: the slope of a time's logarithm.
  constexpr std::array<std::string_view, 8> kUnits = {"s",  "ms", "µs",       "us",
                                                      "ns", "Hz", "exponent", "faults"};
  return unit.ends_with("/s") || std::find(kUnits.begin(), kUnits.end(), unit) != kUnits.end();
}

}  // namespace terrabench
