// What is stored of visibility (MRBSP paper, §4): the first cell's set and the changes between neighbouring
// cells.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "lod/mrbsp/visibility.h"

namespace terrabench {

// The first cell's set, and what toggles from each cell to its right and to its lower neighbour. Element
// numbers rise in every list.
struct VisibilityTable {
  CellGrid cells;
  int depth = 0;  // 0: no table
  float eye_height = 0;
  SurfaceChecksum surface{};
  bool conservative = false;  // of the sets
  std::vector<std::uint32_t> start;
  std::vector<std::uint32_t> first;  // of each step between neighbours, and the end; see step()
  std::vector<std::uint32_t> changes;

  // Steps to the right come first, row by row, then steps down.
  int steps() const { return (cells.columns - 1) * cells.rows + cells.columns * (cells.rows - 1); }
  int step_right(int column, int row) const { return row * (cells.columns - 1) + column; }
  int step_down(int column, int row) const {
    return (cells.columns - 1) * cells.rows + row * cells.columns + column;
  }
  std::span<const std::uint32_t> step(int index) const {
    return std::span(changes).subspan(first[index], first[index + 1] - first[index]);
  }
  bool operator==(const VisibilityTable&) const = default;
};
// Throws usage_error where the changes would take more than 1 GiB. O(bits).
VisibilityTable changes_of(const VisibleSets&);
VisibleSets sets_of(const VisibilityTable&);

// Of a table read from a file: why its numbers before the lists cannot be; empty when they can.
std::string_view head_fault(const VisibilityTable&);
// Does going around each corner of four cells toggle everything back?
bool is_consistent(const VisibilityTable&);

}  // namespace terrabench
