#include "lod/clipmap/height_bounds.h"

#include <algorithm>
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

HeightBounds::Range range_of(const ClipLevel& level, Part x, Part z) {
  HeightBounds::Range range{INFINITY, -INFINITY};
  const int mask = level.side - 1;
  for (int b = z.low; b < z.high; ++b) {
    const float* const row = &level.heights[static_cast<std::size_t>(b & mask) * level.side];
    for (int a = x.low; a < x.high; ++a) {
      range.lowest = std::min(range.lowest, row[a & mask]);
      range.highest = std::max(range.highest, row[a & mask]);
    }
  }
  return range;
}

}  // namespace

HeightBounds::HeightBounds(int window)
    : window_(window),
      mask_(static_cast<int>(std::bit_ceil(static_cast<unsigned>(tile_of(window) + 2))) - 1),
      tiles_(static_cast<std::size_t>(mask_ + 1) * (mask_ + 1)) {}

void HeightBounds::update(const ClipLevel& level) {
  const glm::ivec2 to = level.corner, last = to + window_ - 1;
  for (int z = tile_of(to.y); z <= tile_of(last.y); ++z) {
    const Part rows = part(z, to.y, window_);
    const bool rows_stay = filled_ && rows == part(z, corner_.y, window_);
    for (int x = tile_of(to.x); x <= tile_of(last.x); ++x) {
      const Part columns = part(x, to.x, window_);
      if (rows_stay && columns == part(x, corner_.x, window_)) continue;
      tiles_[index(x, z)] = range_of(level, columns, rows);
    }
  }
  corner_ = to;
  filled_ = true;
}

void HeightBounds::refresh(const ClipLevel& level, glm::ivec2 low, glm::ivec2 high) {
  for (int z = tile_of(low.y); z <= tile_of(high.y); ++z) {
    for (int x = tile_of(low.x); x <= tile_of(high.x); ++x)
      tiles_[index(x, z)] = range_of(level, part(x, corner_.x, window_), part(z, corner_.y, window_));
  }
}

HeightBounds::Range HeightBounds::range(glm::ivec2 low, glm::ivec2 high) const {
  Range range{INFINITY, -INFINITY};
  for (int z = tile_of(low.y); z <= tile_of(high.y); ++z) {
    for (int x = tile_of(low.x); x <= tile_of(high.x); ++x) {
      const Range& tile = tiles_[index(x, z)];
      range.lowest = std::min(range.lowest, tile.lowest);
      range.highest = std::max(range.highest, tile.highest);
    }
  }
  return range;
}

}  // namespace terrabench::clipmap
