// The lowest and highest sample of parts of a clipmap window, for culling. Stored per tile of the level's
// lattice, so that a move updates only the tiles along the window's border. The result depends on the
// window's place only, not on earlier moves. O(n) per move, O(n²) at first, O(n²/64) to query all tiles.
#pragma once

#include <vector>

#include "terrain/frame.h"
#include "terrain/memory.h"

namespace terrabench::clipmap {

class HeightBounds {
 public:
  HeightBounds() = default;
  explicit HeightBounds(int window);  // samples per side

  // To be called after new samples were read. Reads samples corner … corner + window - 1 of the level.
  void update(const ClipLevel&);

  // The samples low … high of the level, in the window of the last update(), have changed. O(their tiles)
  void refresh(const ClipLevel&, glm::ivec2 low, glm::ivec2 high);

  struct Range {
    float lowest, highest;
  };
  // The height range of all tiles that samples low … high touch. Lattice coordinates, both inside the window.
  Range range(glm::ivec2 low, glm::ivec2 high) const;

  Memory memory() const { return index_memory(tiles_); }

 private:
  // Where a row of tiles begins in tiles_: its lowest heights, then its highest.
  std::size_t row(int z) const { return 2 * static_cast<std::size_t>(z & mask_) * (mask_ + 1); }
  void set(int x, int z, const Range&);

  int window_ = 0, mask_ = 0;
  bool filled_ = false;
  glm::ivec2 corner_{0};
  std::vector<float> tiles_;  // toroidal, by row()
};

}  // namespace terrabench::clipmap
