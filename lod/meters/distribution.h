// A histogram of the samples' deviations in pixels over any number of frames, for percentiles over a whole
// path. Bins are 1/256 octave wide; memory is half a megabyte for any path. The order of adding does not
// matter. O(1) per sample.
#pragma once

#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

namespace terrabench {

class Distribution {
 public:
  void add(std::span<const float> pixels);  // ≥ 0

  std::uint64_t samples() const { return samples_; }
  double mean() const { return samples_ == 0 ? 0 : sum_ / static_cast<double>(samples_); }
  double rms() const { return samples_ == 0 ? 0 : std::sqrt(squares_ / static_cast<double>(samples_)); }
  double largest() const { return static_cast<double>(largest_); }
  // `share` of the samples, 0 to 1, are at most this value; exact or up to 0.4 % too high. 0 without samples.
  double quantile(double share) const;

 private:
  static constexpr int kShift = 15;  // leaves the exponent and eight bits of the mantissa
  std::vector<std::uint64_t> counts_ = std::vector<std::uint64_t>((0x7F800000U >> kShift) + 1);
  std::uint64_t samples_ = 0;
  double sum_ = 0, squares_ = 0;
  float largest_ = 0;
};

}  // namespace terrabench
