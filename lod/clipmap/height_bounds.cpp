#include "lod/clipmap/height_bounds.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

namespace terrabench::clipmap {
namespace {

constexpr int kTileBits = 3;  // 8 × 8 samples: at the usual n = 255, updates and queries cost the same

int tile_of(int lattice) { return lattice >> kTileBits; }

// The samples [low, high) that the tile and the window share, along one axis.
struct Part {
  int low, high;
  bool operator==(const Part&) const = default;
};
Part part(int tile, int corner, int window) {
  return {std::max(tile << kTileBits, corner), std::min((tile + 1) << kTileBits, corner + window)};
}

// The extremes of many values, eight at a time: one after another, each would wait for the last.
class Extremes {
 public:
  static constexpr int kLanes = 1 << kTileBits;

  Extremes() {
    low_.fill(INFINITY);
    high_.fill(-INFINITY);
  }
  void add(const float* lows, const float* highs) {
    for (int k = 0; k < kLanes; ++k) add_one(k, lows[k], highs[k]);
  }
  void add(const float* lows, const float* highs, int count) {
    for (; count >= kLanes; count -= kLanes, lows += kLanes, highs += kLanes) add(lows, highs);
    for (int k = 0; k < count; ++k) add_one(k, lows[k], highs[k]);
  }
  // Of lanes [first, end).
  HeightBounds::Range range(int first = 0, int end = kLanes) const {
    return {*std::min_element(low_.begin() + first, low_.begin() + end),
            *std::max_element(high_.begin() + first, high_.begin() + end)};
  }

 private:
  void add_one(int lane, float low, float high) {
    low_[lane] = std::min(low_[lane], low);
    high_[lane] = std::max(high_[lane], high);
  }
  std::array<float, kLanes> low_, high_;
};

// A tile's samples lie beside each other in their rows: all columns are read, and those in the window kept.
HeightBounds::Range range_of(const ClipLevel& level, Part x, Part z) {
  Extremes columns;
  const int mask = level.side - 1, first = x.low & -Extremes::kLanes;
  for (int b = z.low; b < z.high; ++b) {
    const float* const row = &level.heights[static_cast<std::size_t>(b & mask) * level.side + (first & mask)];
    columns.add(row, row);
  }
  return columns.range(x.low - first, x.high - first);
}

}  // namespace

HeightBounds::HeightBounds(int window)
    : window_(window),
      mask_(static_cast<int>(std::bit_ceil(static_cast<unsigned>(tile_of(window) + 2))) - 1),
      tiles_(2 * static_cast<std::size_t>(mask_ + 1) * (mask_ + 1)) {}

void HeightBounds::set(int x, int z, const Range& range) {
  float* const lowest = &tiles_[row(z) + (x & mask_)];
  lowest[0] = range.lowest;
  lowest[mask_ + 1] = range.highest;
}

void HeightBounds::update(const ClipLevel& level) {
  const glm::ivec2 to = level.corner, last = to + window_ - 1;
  // Tiles [whole, whole_end) along x lie in the window before and after.
  const int whole = tile_of(std::max(to.x, corner_.x) - 1) + 1,
            whole_end = tile_of(std::min(to.x, corner_.x) + window_);
  for (int z = tile_of(to.y); z <= tile_of(last.y); ++z) {
    const Part rows = part(z, to.y, window_);
    const bool rows_stay = filled_ && rows == part(z, corner_.y, window_);
    for (int x = tile_of(to.x); x <= tile_of(last.x); ++x) {
      if (rows_stay && x == whole) x = std::max(x, whole_end);
      if (x > tile_of(last.x)) break;
      const Part columns = part(x, to.x, window_);
      if (rows_stay && columns == part(x, corner_.x, window_)) continue;
      set(x, z, range_of(level, columns, rows));
    }
  }
  corner_ = to;
  filled_ = true;
}

void HeightBounds::refresh(const ClipLevel& level, glm::ivec2 low, glm::ivec2 high) {
  for (int z = tile_of(low.y); z <= tile_of(high.y); ++z) {
    for (int x = tile_of(low.x); x <= tile_of(high.x); ++x)
      set(x, z, range_of(level, part(x, corner_.x, window_), part(z, corner_.y, window_)));
  }
}

HeightBounds::Range HeightBounds::range(glm::ivec2 low, glm::ivec2 high) const {
  Extremes extremes;
  const int side = mask_ + 1, first = tile_of(low.x) & mask_, count = tile_of(high.x) - tile_of(low.x) + 1;
  const int before_wrap = std::min(count, side - first);
  for (int z = tile_of(low.y); z <= tile_of(high.y); ++z) {
    const float* const lowest = &tiles_[row(z)];
    extremes.add(lowest + first, lowest + side + first, before_wrap);
    extremes.add(lowest, lowest + side, count - before_wrap);
  }
  return extremes.range();
}

}  // namespace terrabench::clipmap
