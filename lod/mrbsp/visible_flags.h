// What can be seen, at run time (MRBSP paper, §4): a flag a node of the tree. A node's is up when something
// beneath it can be seen, so a walk down the tree stops at the top of what is hidden. Moving toggles what
// changes on the way. O(levels) a coarse triangle toggled.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <vector>

#include "lod/mrbsp/visibility_table.h"
#include "terrain/memory.h"

namespace terrabench {

class VisibleFlags {
 public:
  VisibleFlags() = default;
  explicit VisibleFlags(const VisibilityTable&);  // in the first cell

  // Returns how many coarse triangles were toggled. The table must be the one it was made with.
  std::size_t move_to(const VisibilityTable&, glm::ivec2 cell);
  int depth() const { return depth_; }  // the table's; 0: no flags
  // Of a node down to the table's depth.
  bool operator[](NodeNumber node) const { return ((flags_[node / 64] >> (node % 64)) & 1) != 0; }
  glm::ivec2 cell() const { return cell_; }
  Memory memory() const { return payload_memory(flags_); }

 private:
  void toggle(NodeNumber leaf);

  int depth_ = 0;
  std::vector<std::uint64_t> flags_;
  glm::ivec2 cell_{0};
};

}  // namespace terrabench
