#include "terrain/tin/triangle_scan.h"

#include <bit>

#include "terrain/tin/triangle_plane.h"

namespace terrabench::tin {
namespace {

constexpr int kShort = 16;  // samples of a row, too few for vectors

float miss_at(const float* heights, int i, float first, float slope) {
  return std::abs(heights[i] - (first + slope * static_cast<float>(i)));
}

// The greatest |heights[i] - (first + slope · i)|. Floats that are not negative are ordered as whole numbers,
// whose maximum compilers vectorise.
float largest_miss(const float* heights, int count, float first, float slope) {
  std::int32_t worst = 0;
  for (int i = 0; i < count; ++i) {
    const float miss = miss_at(heights, i, first, slope);
    worst = std::max(worst, std::bit_cast<std::int32_t>(miss));
  }
  return std::bit_cast<float>(worst);
}

int first_miss(const float* heights, int count, float first, float slope, float miss) {
  for (int i = 0; i < count; ++i) {
    if (miss_at(heights, i, first, slope) == miss) return i;
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
    const Rows::Columns columns = rows.columns(j);
    const int count = columns.east - columns.west + 1;
    if (count < 1) continue;
    const float* const heights = ground.at(columns.west, j);
    const auto first = static_cast<float>(plane(columns.west, j));
    const auto put = [&](float miss, int i) {
      worst = {miss, {static_cast<std::uint16_t>(columns.west + i), static_cast<std::uint16_t>(j)}};
    };
    if (count < kShort) {
      for (int i = 0; i < count; ++i) {
        const float miss = miss_at(heights, i, first, slope);
        if (miss > worst.error) put(miss, i);
      }
      continue;
    }
    const float miss = largest_miss(heights, count, first, slope);
    if (miss > worst.error) put(miss, first_miss(heights, count, first, slope, miss));
  }
  return worst;
}

}  // namespace terrabench::tin
