// Visibility at run time (MRBSP paper, §4): one visibility flag per node of the tree, set if any coarse
// triangle in the node's subtree is visible, so a walk down the tree stops at the topmost hidden node. Moving
// to another cell toggles the changes of every step on the way. O(levels) per coarse triangle toggled.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <vector>

#include "lod/mrbsp/visibility/change_table.h"
#include "terrain/memory.h"

namespace terrabench::mrbsp::visibility {

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
