#include "lod/meters/distribution.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace terrabench {

void Distribution::add(std::span<const float> pixels) {
  for (const float p : pixels) {
    ++counts_[std::bit_cast<std::uint32_t>(p) >> kShift];
    sum_ += static_cast<double>(p);
    squares_ += static_cast<double>(p) * static_cast<double>(p);
    largest_ = std::max(largest_, p);
  }
  samples_ += pixels.size();
}

double Distribution::quantile(double share) const {
  if (samples_ == 0) return 0;
  const auto rank = static_cast<std::uint64_t>(std::ceil(share * static_cast<double>(samples_)));
  std::uint64_t below = 0;
  std::uint32_t bin = 0;
  while ((below += counts_[bin]) < std::max<std::uint64_t>(rank, 1)) ++bin;
  // The top of the bin; 0 for the first bin, which holds practically only zeros.
  const float top = bin == 0 ? 0 : std::bit_cast<float>(((bin + 1) << kShift) - 1);
  return static_cast<double>(std::min(top, largest_));
}

}  // namespace terrabench
