#include "representations/tin/triangle_scan.h"

#include <bit>

#include "representations/tin/triangle_plane.h"

namespace terrabench::tin {
namespace {

// The greatest |heights[i] - (first + slope · i)|. Floats that are not negative are ordered as whole numbers,
// whose maximum compilers vectorise.
float largest_miss(const float* heights, int count, float first, float slope) {
  std::int32_t worst = 0;
  for (int i = 0; i < count; ++i) {
    const float miss = std::abs(heights[i] - (first + slope * static_cast<float>(i)));
    worst = std::max(worst, std::bit_cast<std::int32_t>(miss));
  }
  return std::bit_cast<float>(worst);
}

int first_miss(const float* heights, int count, float first, float slope, float miss) {
  for (int i = 0; i < count; ++i) {
    if (std::abs(heights[i] - (first + slope * static_cast<float>(i))) == miss) return i;
  }
  return count - 1;
}

}  // namespace

Candidate worst_sample(const std::array<Sample, 3>& p, const std::array<float, 3>& h,
                       const HeightsView& ground) {
  Candidate worst;
  if (twice_area(p[0], p[1], p[2]) == 1) return worst;  // holds no other sample
  const Plane plane(p, h);
  const auto slope = static_cast<float>(plane.per_i);
  const Rows rows(p);
  for (int j = rows.first(); j <= rows.last(); ++j) {
    const auto [west, east] = rows.columns(j);
    if (east < west) continue;
    const float* const heights = ground.at(west, j);
    const int count = east - west + 1;
    const auto first = static_cast<float>(plane(west, j));
    const float miss = largest_miss(heights, count, first, slope);
    if (!(miss > worst.error)) continue;
    const int i = west + first_miss(heights, count, first, slope, miss);
    worst = {miss, {static_cast<std::uint16_t>(i), static_cast<std::uint16_t>(j)}};
  }
  return worst;
}

}  // namespace terrabench::tin
