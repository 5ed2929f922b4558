#include "terrain/sources/fractal/limits.h"

#include <fmt/format.h>

#include <numbers>

#include "terrain/error.h"
#include "terrain/memory.h"

namespace terrabench::fractal {

void check_side(int samples, std::string_view what, std::string_view where) {
  if (samples >= 2 && samples <= kLargestSide) return;
  throw usage_error(fmt::format("{} must be between 2 and {} samples, got {}", what, kLargestSide, samples),
                    where, "choose a number in this range");
}

void check_between(double value, double low, double high, std::string_view what, std::string_view where) {
  if (value >= low && value <= high) return;  // false for NaN
  throw usage_error(fmt::format("{} must be between {} and {}, got {}", what, low, high, value), where,
                    "choose a number in this range");
}

void check_memory(std::int64_t width, std::int64_t depth, std::string_view where) {
  const std::uint64_t bytes = static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(depth) * 4;
  require_memory(bytes, fmt::format("{}: {} × {} samples", where, width, depth), "ask for fewer samples");
}

float level_range(float amplitude, float hurst, int level) {
  // 2^-hurst by its series: the library's exp2 may round otherwise on another machine.
  const double x = -static_cast<double>(hurst) * std::numbers::ln2;
  double factor = 1, term = 1;
  for (int k = 1; k < 24; ++k) {
    term *= x / k;
    factor += term;
  }
  double range = amplitude;
  for (int i = 0; i < level; ++i) range *= factor;
  return static_cast<float>(range);
}

}  // namespace terrabench::fractal
