#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "representations/drill/regenerate.cpp"
#include "representations/drill/regenerate.h"

#include <hwy/foreach_target.h>  // re-includes this file for each target
#include <hwy/highway.h>

#include <algorithm>
#include <cstdint>

#ifndef TERRABENCH_DRILL_TILE
#define TERRABENCH_DRILL_TILE
namespace terrabench {

inline constexpr std::size_t kMostLanes = 16;

// A rectangle of pixels being drilled, with margins left and right so that windows need no clipping there.
struct DrillTile {
  int row, rows;   // of the terrain
  int left;        // the terrain's column at the tile's first column
  float* heights;  // of (left, row)
  std::size_t stride;
  const float* distance;  // √(i² + j²) for j = 0 … k, i = -k … k, rows `distance_stride` apart
  std::size_t distance_stride;
};

}  // namespace terrabench
#endif

HWY_BEFORE_NAMESPACE();
namespace terrabench {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using F = hn::CappedTag<float, kMostLanes>;

struct Shape {
  hn::Vec<F> c, a, b;
  // Rounding keeps c + r·(a + b·r) monotone in r for a, b ≥ 0, which pits.h relies on. No fused multiply-add:
  // all instruction sets then agree to the bit.
  HWY_INLINE hn::Vec<F> at(const float* distance) const {
    const auto r = hn::LoadU(F(), distance);
    return hn::Add(c, hn::Mul(r, hn::Add(a, hn::Mul(b, r))));
  }
};

HWY_INLINE void lower(hn::Vec<F> shape, float* to) {
  hn::StoreU(hn::Min(hn::LoadU(F(), to), shape), F(), to);
}

// Heights past the window do not change. A masked store could fault or be slow; the tile's margin may be
// rewritten.
HWY_INLINE void lower(hn::Vec<F> shape, hn::Mask<F> inside, float* to) {
  const auto before = hn::LoadU(F(), to);
  hn::StoreU(hn::IfThenElse(inside, hn::Min(before, shape), before), F(), to);
}

// The rows j above and below the centre share their shape. `up` or `down` may be null, outside the tile.
HWY_INLINE void lower_rows(const Shape& shape, const float* distance, std::size_t size, float* up,
                           float* down) {
  const std::size_t lanes = hn::Lanes(F()), whole = size / lanes * lanes;
  const auto inside = hn::FirstN(F(), size - whole);
  if (up != nullptr && down != nullptr) {
    for (std::size_t i = 0; i < whole; i += lanes) {
      const auto heights = shape.at(distance + i);
      lower(heights, up + i);
      lower(heights, down + i);
    }
    const auto heights = shape.at(distance + whole);
    lower(heights, inside, up + whole);
    lower(heights, inside, down + whole);
  } else if (float* const to = up != nullptr ? up : down; to != nullptr) {
    for (std::size_t i = 0; i < whole; i += lanes) lower(shape.at(distance + i), to + i);
    lower(shape.at(distance + whole), inside, to + whole);
  }
}

void drill(const Drills& drills, std::size_t first, std::size_t last, int y, const DrillTile& tile) {
  const auto row_start = static_cast<std::uint32_t>(y) * static_cast<std::uint32_t>(drills.width);
  for (std::size_t i = first; i < last; ++i) {
    const int x = static_cast<int>(drills.pixel[i] - row_start), k = drills.influence_of(i);
    const Shape shape{hn::Set(F(), drills.elevation[i]), hn::Set(F(), drills.slope[i]),
                      hn::Set(F(), drills.curvature[i])};
    const std::size_t size = 2 * static_cast<std::size_t>(k) + 1;
    const auto window_row = [&](int row) -> float* {
      if (row < tile.row || row >= tile.row + tile.rows) return nullptr;
      return tile.heights + static_cast<std::size_t>(row - tile.row) * tile.stride + (x - k - tile.left);
    };
    for (int j = 0; j <= k; ++j) {
      const float* const distance =
          tile.distance + static_cast<std::size_t>(j) * tile.distance_stride + (drills.k - k);
      lower_rows(shape, distance, size, window_row(y - j), j > 0 ? window_row(y + j) : nullptr);
    }
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace terrabench
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include <tbb/blocked_range2d.h>
#include <tbb/parallel_for.h>

#include <cmath>
#include <vector>

namespace terrabench {

HWY_EXPORT(drill);

namespace {

// Large compared with windows, so that few drills reach into several tiles, and small enough for the
// second-level cache.
constexpr int kTileRows = 50, kTileColumns = 1024;

std::size_t distance_stride(int k) { return 2 * static_cast<std::size_t>(k) + 1 + kMostLanes; }

std::vector<float> distance_table(int k) {
  std::vector<float> table(distance_stride(k) * (static_cast<std::size_t>(k) + 1));
  for (int j = 0; j <= k; ++j) {
    float* const row = table.data() + static_cast<std::size_t>(j) * distance_stride(k);
    for (int i = -k; i <= k; ++i) row[i + k] = std::sqrt(static_cast<float>(i * i + j * j));
  }
  return table;
}

// The drills in columns [begin, end) of a row.
std::pair<std::size_t, std::size_t> drills_in(const Drills& drills, int row, int begin, int end) {
  const auto at = [&](int column) {
    const std::uint64_t pixel = static_cast<std::uint64_t>(row) * static_cast<std::uint64_t>(drills.width) +
                                static_cast<std::uint64_t>(std::clamp(column, 0, drills.width));
    return static_cast<std::size_t>(std::lower_bound(drills.pixel.begin(), drills.pixel.end(), pixel) -
                                    drills.pixel.begin());
  };
  return {at(begin), at(end)};
}

void regenerate_tile(const Drills& drills, int row, int column, const std::vector<float>& distance,
                     std::vector<float>& scratch, std::span<float> heights) {
  const int k = drills.k, rows = std::min(kTileRows, drills.depth - row);
  const int columns = std::min(kTileColumns, drills.width - column);
  // The window of a drill k pixels outside the tile begins 2k pixels outside.
  const std::size_t stride = static_cast<std::size_t>(columns) + 4 * static_cast<std::size_t>(k) + kMostLanes;
  scratch.assign(stride * static_cast<std::size_t>(rows), drills.plateau);
  const DrillTile tile{
      row, rows, column - 2 * k, scratch.data(), stride, distance.data(), distance_stride(k)};
  for (int y = std::max(row - k, 0); y < std::min(row + rows + k, drills.depth); ++y) {
    const auto [first, last] = drills_in(drills, y, column - k, column + columns + k);
    HWY_DYNAMIC_DISPATCH(drill)(drills, first, last, y, tile);
  }
  for (int j = 0; j < rows; ++j) {
    std::copy_n(
        scratch.data() + static_cast<std::size_t>(j) * stride + 2 * static_cast<std::size_t>(k), columns,
        heights.data() + static_cast<std::size_t>(row + j) * static_cast<std::size_t>(drills.width) + column);
  }
}

}  // namespace

void regenerate(const Drills& drills, std::span<float> heights) {
  const std::vector<float> distance = distance_table(drills.k);
  const auto tiles = [](int size, int tile) { return (size + tile - 1) / tile; };
  using Range = tbb::blocked_range2d<int>;
  const Range all(0, tiles(drills.depth, kTileRows), 0, tiles(drills.width, kTileColumns));
  tbb::parallel_for(all, [&](const Range& range) {
    std::vector<float> scratch;
    for (int j = range.rows().begin(); j < range.rows().end(); ++j) {
      for (int i = range.cols().begin(); i < range.cols().end(); ++i) {
        regenerate_tile(drills, j * kTileRows, i * kTileColumns, distance, scratch, heights);
      }
    }
  });
  for (const HoleRun& hole : drills.holes) {
    std::fill_n(heights.data() + hole.first, hole.count, Heightfield::kNoData);
  }
}

Heightfield regenerate(const Drills& drills) {
  Heightfield field = Heightfield::zeros(drills.width, drills.depth, drills.cell_x, drills.cell_z);
  regenerate(drills, field.heights);
  if (drills.interpolated) interpolate_untouched(drills, field);
  return field;
}

std::size_t count_untouched(const Drills& drills, std::span<const float> heights) {
  return static_cast<std::size_t>(
      std::count_if(heights.begin(), heights.end(), [&](float h) { return h >= drills.plateau; }));
}

void interpolate_untouched(const Drills& drills, Heightfield& heights) {
  const std::size_t untouched = count_untouched(drills, heights.heights);
  Heightfield touched = heights;
  for (float& h : touched.heights) {
    if (!is_touched(h, drills)) h = Heightfield::kNoData;
  }
  if (untouched == 0 || height_range(touched).no_data == touched.heights.size()) return;
  const Heightfield smooth = fill_no_data(touched);
  for (std::size_t i = 0; i < heights.heights.size(); ++i) {
    if (heights.heights[i] >= drills.plateau) heights.heights[i] = smooth.heights[i];
  }
}

}  // namespace terrabench
#endif
