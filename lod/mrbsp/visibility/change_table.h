// The stored form of visible sets (MRBSP paper, §4 and table 1): the first cell's set, and the changes in
// visibility between neighbouring cells.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <span>
#include <string_view>
#include <vector>

#include "lod/mrbsp/visibility/sets.h"
#include "terrain/memory.h"

namespace terrabench::mrbsp::visibility {

// Element numbers (Sets) rise strictly in every list.
struct ChangeTable {
  CellGrid cells;
  int depth = 0;  // 0: no table
  float eye_height = 0;
  GroundChecksum ground{};
  Mode mode = Mode::kSampled;
  std::vector<std::uint32_t> start;  // the set of cell (0, 0)
  // changes[first[s]] to changes[first[s + 1]] toggle at step s: between a cell and its right or lower
  // neighbour.
  std::vector<std::uint32_t> first, changes;

  // Steps to the right come first, row by row, then steps down.
  int steps() const { return (cells.columns - 1) * cells.rows + cells.columns * (cells.rows - 1); }
  int step_right(int column, int row) const { return row * (cells.columns - 1) + column; }
  int step_down(int column, int row) const {
    return (cells.columns - 1) * cells.rows + row * cells.columns + column;
  }
  std::span<const std::uint32_t> step(int index) const {
    return std::span(changes).subspan(first[index], first[index + 1] - first[index]);
  }
  bool operator==(const ChangeTable&) const = default;
};

// Calls body(step, from, to) with the (column, row) of both cells, for every step in the table's order.
template <class Body>
void each_step(const CellGrid& cells, const Body& body) {
  int step = 0;
  for (int row = 0; row < cells.rows; ++row) {
    for (int column = 0; column + 1 < cells.columns; ++column) {
      body(step++, glm::ivec2(column, row), glm::ivec2(column + 1, row));
    }
  }
  for (int row = 0; row + 1 < cells.rows; ++row) {
    for (int column = 0; column < cells.columns; ++column) {
      body(step++, glm::ivec2(column, row), glm::ivec2(column, row + 1));
    }
  }
}

// O(bits). changes_of() throws usage_error if the changes would take more than 1 GiB.
ChangeTable changes_of(const Sets&);
Sets sets_of(const ChangeTable&);

// Why a decoded table's cells, depth, eye height or checksum are invalid; empty if they are valid.
std::string_view header_error(const ChangeTable&);
// Whether the four steps around each corner of four cells cancel out.
bool is_consistent(const ChangeTable&);

// Visibility at run time (MRBSP paper, §4): one visibility flag per node of the tree, set if any coarse
// triangle in the node's subtree is visible, so a walk down the tree stops at the topmost hidden node. Moving
// to another cell toggles the changes of every step on the way. O(levels) per coarse triangle toggled.
class Flags {
 public:
  Flags() = default;
  explicit Flags(const ChangeTable&);  // for cell (0, 0)

  // Returns the number of coarse triangles toggled. The table must be the one that the flags were made with.
  std::size_t move_to(const ChangeTable&, glm::ivec2 cell);
  int depth() const { return depth_; }  // of the coarse triangles; 0: no flags
  // For nodes at depth() or above.
  bool operator[](NodeNumber node) const { return ((flags_[node / 64] >> (node % 64)) & 1) != 0; }
  glm::ivec2 cell() const { return cell_; }
  Memory memory() const { return payload_memory(flags_); }

 private:
  void toggle(NodeNumber coarse_triangle);

  int depth_ = 0;
  std::vector<std::uint64_t> flags_;
  glm::ivec2 cell_{0};
};

}  // namespace terrabench::mrbsp::visibility
