#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "representations/drill/regenerate.cpp"
#include "representations/drill/regenerate.h"

#include <hwy/foreach_target.h>  // re-includes this file for each target
#include <hwy/highway.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>

#ifndef TERRABENCH_DRILL_BAND
#define TERRABENCH_DRILL_BAND
namespace terrabench {

// A few rows being drilled, with a margin of the largest window left and right, so that windows need no
// clipping.
struct DrillBand {
  const Drills* drills;
  std::size_t first, last;  // drills whose windows may reach the rows
  int row, rows;
  float* heights;
  std::size_t stride;
  const float* distance;  // √(i² + j²) for j = 0 … k, i = -k … k
};

}  // namespace terrabench
#endif

HWY_BEFORE_NAMESPACE();
namespace terrabench {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// One row of one window. Rounding keeps c + d·(a + b·d) monotone in d for a, b ≥ 0, which pits.h relies on.
// No fused multiply-add: all instruction sets then agree to the bit.
template <class D>
HWY_INLINE void lower(D d, const float* HWY_RESTRICT distance, float c, float a, float b,
                      float* HWY_RESTRICT to) {
  const auto r = hn::LoadU(d, distance);
  const auto shape = hn::Add(hn::Set(d, c), hn::Mul(r, hn::Add(hn::Set(d, a), hn::Mul(hn::Set(d, b), r))));
  hn::StoreU(hn::Min(hn::LoadU(d, to), shape), d, to);
}

void drill_rows(const DrillBand& band) {
  const hn::ScalableTag<float> many;
  const hn::CappedTag<float, 1> one;
  const Drills& drills = *band.drills;
  const auto lanes = static_cast<std::ptrdiff_t>(hn::Lanes(many));
  const std::ptrdiff_t table_stride = 2 * std::ptrdiff_t{drills.k} + 1;
  for (std::size_t i = band.first; i < band.last; ++i) {
    const int y = static_cast<int>(drills.pixel[i] / static_cast<std::uint32_t>(drills.width));
    const int x = static_cast<int>(drills.pixel[i] % static_cast<std::uint32_t>(drills.width));
    const int k = drills.influence_of(i);
    const float c = drills.elevation[i], a = drills.slope[i], b = drills.curvature[i];
    const std::ptrdiff_t size = 2 * std::ptrdiff_t{k} + 1;
    for (int row = std::max(y - k, band.row); row <= std::min(y + k, band.row + band.rows - 1); ++row) {
      const float* const distance = band.distance + std::abs(row - y) * table_stride + (drills.k - k);
      float* const to = band.heights + static_cast<std::size_t>(row - band.row) * band.stride +
                        static_cast<std::size_t>(x + drills.k - k);
      if (size < lanes) {
        for (std::ptrdiff_t at = 0; at < size; ++at) lower(one, distance + at, c, a, b, to + at);
        continue;
      }
      std::ptrdiff_t at = 0;
      for (; at + lanes <= size; at += lanes) lower(many, distance + at, c, a, b, to + at);
      // The last vector overlaps the one before: lowering twice is lowering once.
      if (at < size) lower(many, distance + size - lanes, c, a, b, to + size - lanes);
    }
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace terrabench
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <cmath>
#include <vector>

namespace terrabench {

HWY_EXPORT(drill_rows);

namespace {

// Enough rows that a drill's set-up is paid rarely, few enough that a band stays in the second-level cache.
constexpr int kBandRows = 16;

std::vector<float> distance_table(int k) {
  std::vector<float> table;
  for (int j = 0; j <= k; ++j) {
    for (int i = -k; i <= k; ++i) table.push_back(std::sqrt(static_cast<float>(i * i + j * j)));
  }
  return table;
}

std::size_t first_from_row(const Drills& drills, int row) {
  const auto pixel = static_cast<std::uint64_t>(std::max(row, 0)) * static_cast<std::uint64_t>(drills.width);
  return static_cast<std::size_t>(std::lower_bound(drills.pixel.begin(), drills.pixel.end(), pixel) -
                                  drills.pixel.begin());
}

}  // namespace

void regenerate(const Drills& drills, std::span<float> heights) {
  const std::vector<float> distance = distance_table(drills.k);
  const std::size_t width = static_cast<std::size_t>(drills.width),
                    margin = static_cast<std::size_t>(drills.k);
  const int bands = (drills.depth + kBandRows - 1) / kBandRows;
  tbb::parallel_for(tbb::blocked_range<int>(0, bands), [&](const tbb::blocked_range<int>& range) {
    DrillBand band{&drills, 0, 0, 0, 0, nullptr, width + 2 * margin, distance.data()};
    std::vector<float> rows(band.stride * kBandRows);
    band.heights = rows.data();
    for (int b = range.begin(); b < range.end(); ++b) {
      band.row = b * kBandRows;
      band.rows = std::min(kBandRows, drills.depth - band.row);
      band.first = first_from_row(drills, band.row - drills.k);
      band.last = first_from_row(drills, band.row + band.rows + drills.k);
      std::fill(rows.begin(), rows.end(), drills.plateau);
      HWY_DYNAMIC_DISPATCH(drill_rows)(band);
      for (int j = 0; j < band.rows; ++j) {
        std::copy_n(rows.data() + static_cast<std::size_t>(j) * band.stride + margin, width,
                    heights.data() + static_cast<std::size_t>(band.row + j) * width);
      }
    }
  });
  for (const HoleRun& hole : drills.holes) {
    std::fill_n(heights.data() + hole.first, hole.count, Heightfield::kNoData);
  }
}

Heightfield regenerate(const Drills& drills) {
  Heightfield field;
  field.width = drills.width;
  field.depth = drills.depth;
  field.cell_x = drills.cell_x;
  field.cell_z = drills.cell_z;
  field.heights.resize(drills.pixels());
  regenerate(drills, field.heights);
  return field;
}

std::size_t count_untouched(const Drills& drills, std::span<const float> heights) {
  return static_cast<std::size_t>(
      std::count_if(heights.begin(), heights.end(), [&](float h) { return h >= drills.plateau; }));
}

void interpolate_untouched(const Drills& drills, Heightfield& heights) {
  bool any = false;
  Heightfield sparse = heights;
  for (float& h : sparse.heights) {
    if (is_touched(h, drills)) {
      any = true;
    } else {
      h = Heightfield::kNoData;
    }
  }
  if (!any) return;
  const Heightfield smooth = fill_no_data(sparse);
  for (std::size_t i = 0; i < heights.heights.size(); ++i) {
    if (heights.heights[i] >= drills.plateau) heights.heights[i] = smooth.heights[i];
  }
}

}  // namespace terrabench
#endif
