// The division of a field of any size into patches: squares of side × side cells that share their border
// vertices. The last patches to the east and south are cut at the field's border.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>

namespace terrabench {

struct PatchGrid {
  int width = 0, depth = 0;  // samples of the field
  int side = 0;              // cells, a power of two

  int across() const { return (width - 2) / side + 1; }
  int down() const { return (depth - 2) / side + 1; }
  std::size_t count() const { return static_cast<std::size_t>(across()) * down(); }

  struct Patch {
    int i0, j0;         // low corner, samples
    int columns, rows;  // cells
  };
  Patch patch(int at_x, int at_z) const {
    const int i0 = at_x * side, j0 = at_z * side;
    return {i0, j0, std::min(side, width - 1 - i0), std::min(side, depth - 1 - j0)};
  }

  struct PatchRect {  // patches x0 to x1 and z0 to z1, both included
    int x0, x1, z0, z1;
  };
  PatchRect all() const { return {0, across() - 1, 0, down() - 1}; }
  // The patches that hold one of the samples `low` to `high`, both included; patches share border samples.
  PatchRect holding(glm::ivec2 low, glm::ivec2 high) const {
    return {std::max(low.x - 1, 0) / side, std::min(high.x / side, across() - 1),
            std::max(low.y - 1, 0) / side, std::min(high.y / side, down() - 1)};
  }

  // Arrays by slot have a rim of one slot, so that each patch has four neighbours, at slot + offsets()[side].
  std::size_t slots() const { return static_cast<std::size_t>(across() + 2) * (down() + 2); }
  std::uint32_t slot(int at_x, int at_z) const {
    return static_cast<std::uint32_t>(at_z + 1) * static_cast<std::uint32_t>(across() + 2) +
           static_cast<std::uint32_t>(at_x + 1);
  }
  Patch patch(std::uint32_t slot) const {
    const auto stride = static_cast<std::uint32_t>(across() + 2);
    return patch(static_cast<int>(slot % stride) - 1, static_cast<int>(slot / stride) - 1);
  }
  std::array<std::int32_t, 4> offsets() const { return {-(across() + 2), 1, across() + 2, -1}; }

  // 0: whole; 1: cut to the east; 2: to the south; 3: both.
  int shape(const Patch& patch) const { return (patch.columns < side ? 1 : 0) + (patch.rows < side ? 2 : 0); }
};

// Sides of a patch; side s is bit s of a set of seams. The opposite of side s is s ^ 2.
enum Side : int { kNorth = 0, kEast = 1, kSouth = 2, kWest = 3 };

}  // namespace terrabench
