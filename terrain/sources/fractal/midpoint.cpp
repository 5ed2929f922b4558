#include "terrain/sources/fractal/midpoint.h"

#include <cstddef>

#include "terrain/sources/fractal/counter_random.h"
#include "terrain/sources/fractal/limits.h"

namespace terrabench::fractal {

std::vector<float> midpoint_displacement(const MidpointOptions& options) {
  constexpr char kWhere[] = "midpoint displacement";
  check_between(options.levels, 0, 24, "levels", kWhere);
  check_between(options.amplitude, 0, kLargestMetres, "amplitude", kWhere);
  check_between(options.hurst, 0, 1, "hurst", kWhere);
  check_between(options.left, -kLargestMetres, kLargestMetres, "left", kWhere);
  check_between(options.right, -kLargestMetres, kLargestMetres, "right", kWhere);

  const std::size_t last = std::size_t{1} << options.levels;
  std::vector<float> heights(last + 1);
  heights.front() = options.left;
  heights.back() = options.right;
  for (int level = 0; level < options.levels; ++level) {
    const std::size_t step = last >> level;
    const RowKey key = row_key(options.seed, kMidpoints, static_cast<std::uint64_t>(level));
    const float range = level_range(options.amplitude, options.hurst, level);
    for (std::size_t i = 0; i < last; i += step) {
      heights[i + step / 2] = 0.5F * (heights[i] + heights[i + step]) +
                              range * displacement(key, static_cast<std::uint32_t>(i / step));
    }
  }
  return heights;
}

}  // namespace terrabench::fractal
