// How low and how high the ground lies under the upper triangles of a bisection tree, for culling by the
// view. Built in O(triangles), in parallel.
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

  // Bounds are kept down to here: what is smaller is culled with the triangle above it.
  int depth() const { return depth_; }
  // Of the triangle's whole subtree.
  const Range& operator[](NodeNumber node) const { return ranges_[node]; }
  Memory memory() const { return index_memory(ranges_); }

 private:
  int depth_ = 0;
  std::vector<Range> ranges_;  // by node number
};

}  // namespace terrabench
