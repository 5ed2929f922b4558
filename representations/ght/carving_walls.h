// The walls of a tunnel or cave: one indoor heightmap per side of the section, with rows along the axis,
// columns across the side, and smooth noise for heights (Alonso, Joan-Arinyo & Solano, §3.2, figures 15 and
// 16: FillNoiseData, LinkRingInner). Each column ends at its last row under the ground. O(cells).
#pragma once

#include "representations/ght/edit.h"

namespace terrabench::ght {

struct CarvingWalls {
  const events::Carving& event;
  events::Line line;
  int steps = 1;                           // rows from `from` to `to`; row 0 is at `from`
  double step = 0;                         // metres along the axis in plan, per row
  std::vector<int> first_column{};         // of each side, in order around the section; then their number
  std::vector<int> low_row{}, high_row{};  // first and last row under ground of each column
  int row0 = 0, row1 = 0;                  // of all columns
  std::vector<GroundedHeightmap> sides{};

  int columns(std::size_t side) const { return first_column[side + 1] - first_column[side]; }
  // The column's number around the section; the last of a side is the first of the next.
  std::size_t around(std::size_t side, int column) const {
    return static_cast<std::size_t>((first_column[side] + column) % first_column.back());
  }
  // A vector of the section, to the right and up, in space.
  glm::dvec3 vector(glm::dvec2 section) const {
    return {-line.left.x * section.x, section.y, -line.left.y * section.x};
  }
};

// Appends the walls and their faces to the Edit. Refuses a carving that leaves the ground between `from` and
// `to`, does not come out beyond them, or comes near another carving or an overhang.
CarvingWalls append_walls(Edit& edit, const events::Carving& event);

[[noreturn]] void refuse_mouth(const Edit& edit);

}  // namespace terrabench::ght
