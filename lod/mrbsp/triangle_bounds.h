// Lowest and highest ground in the upper triangles of a bisection tree, for culling by the view frustum.
// Built in O(triangles), in parallel.
#pragma once

#include <vector>

#include "lod/mrbsp/bisection_tree.h"
#include "terrain/frame.h"
#include "terrain/memory.h"
#include "terrain/progress.h"

namespace terrabench {

class TriangleBounds {
 public:
  struct Range {
    float lowest, highest;  // metres
  };

  TriangleBounds() = default;
  TriangleBounds(const GroundGrid&, const BisectionTree&, Progress&);

  // The heights at samples low … high have changed. O(triangles that touch them)
  void update(const GroundGrid&, const BisectionTree&, glm::ivec2 low, glm::ivec2 high);

  // Bounds are stored down to this depth; deeper triangles are culled with their ancestor.
  int depth() const { return depth_; }
  // The range over the triangle's whole subtree.
  const Range& operator[](NodeNumber node) const { return ranges_[node]; }
  Memory memory() const { return index_memory(ranges_); }

 private:
  int depth_ = 0;
  std::vector<Range> ranges_;  // by node number
};

}  // namespace terrabench
