// Between which heights the parts of a clipmap window lie, for culling: kept by tiles of the level's lattice,
// so that a move renews only the tiles along the window's border and not the whole window. The same for any
// way to a place. O(n) a move, O(n²/64) the first time and for a query of the whole window.
#pragma once

#include <vector>

#include "terrain/frame.h"
#include "terrain/memory.h"

namespace terrabench::clipmap {

class HeightBounds {
 public:
  HeightBounds() = default;
  explicit HeightBounds(int window);  // samples a side

  // After the window's heights were renewed. Looks at samples corner … corner + window - 1 of the level.
  void follow(const ClipLevel&);

  struct Range {
    float lowest, highest;
  };
  // Of the tiles that samples low … high touch: lattice coordinates, both inside the window.
  Range range(glm::ivec2 low, glm::ivec2 high) const;

  Memory memory() const { return index_memory(tiles_); }

 private:
  Range& tile(int x, int z) {
    return tiles_[static_cast<std::size_t>(z & mask_) * (mask_ + 1) + (x & mask_)];
  }
  const Range& tile(int x, int z) const {
    return tiles_[static_cast<std::size_t>(z & mask_) * (mask_ + 1) + (x & mask_)];
  }

  int window_ = 0, mask_ = 0;
  bool filled_ = false;
  glm::ivec2 corner_{0};
  std::vector<Range> tiles_;  // toroidal
};

}  // namespace terrabench::clipmap
