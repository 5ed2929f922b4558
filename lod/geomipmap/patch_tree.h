// The quadtree over the patches that culls them (de Boer 2000, §2.2): a pyramid of flat arrays with the
// lowest and highest ground of each node. O(patches) to build; visiting costs the nodes that cross the
// frustum's border and the patches inside.
#pragma once

#include <vector>

#include "lod/geomipmap/patch_grid.h"
#include "terrain/frame.h"
#include "terrain/frustum.h"
#include "terrain/memory.h"

namespace terrabench {

class PatchTree {
 public:
  PatchTree(const GroundGrid&, const PatchGrid&);

  struct Seen {
    std::uint32_t slot;
    int x, z;  // of the patch, in patches
  };
  // Appends the patches that the frustum may see, in the order of the tree.
  void collect(const Frustum&, std::vector<Seen>& seen) const;
  Bounds box(const Seen& patch) const { return box(0, patch.x, patch.z); }
  Memory memory() const;

 private:
  struct Range {
    float lowest, highest;
  };
  struct Level {
    int across, down;
    std::size_t first;  // of its nodes
  };
  Bounds box(int level, int at_x, int at_z) const;
  void collect(int level, int at_x, int at_z, bool inside, const Frustum&, std::vector<Seen>&) const;

  PatchGrid cut_;
  float cell_x_, cell_z_;
  std::vector<Level> levels_;  // the patches first, one node last
  std::vector<Range> nodes_;
};

}  // namespace terrabench
