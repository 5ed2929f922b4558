// The quadtree over the patches that culls them (de Boer 2000, §2.2): a pyramid of flat arrays with the
// lowest and highest ground of each node. Patches are numbered so that those of any node follow each other:
// what is in view is a few runs of numbers, and what is kept by number is gone through in order. O(patches)
// to build; visiting costs the nodes that cross the frustum's border.
#pragma once

#include <span>
#include <vector>

#include "lod/geomipmap/patch_grid.h"
#include "lod/screen_bound.h"
#include "terrain/frame.h"
#include "terrain/frustum.h"
#include "terrain/memory.h"
#include "terrain/solid.h"

namespace terrabench {

class PatchTree {
 public:
  PatchTree(const GroundGrid&, const PatchGrid&);

  struct Place {
    std::uint32_t slot;
    std::uint32_t corner;  // vertex
    std::int32_t shape;
  };
  std::span<const Place> places() const { return places_; }  // by number
  const Boxes& boxes() const { return boxes_; }              // by number

  struct Run {
    std::uint32_t first, last;  // one past the last
  };
  // Appends the patches that the frustum may see, in the order of their numbers.
  void collect(const Frustum&, std::vector<Run>& seen) const;
  // No frustum sees more runs.
  std::size_t most_runs() const { return (places_.size() + 1) / 2; }
  Memory memory() const;

 private:
  struct Node {
    float lowest, highest;
    Run patches;
  };
  struct Level {
    int across, down;
    std::size_t first;  // of its nodes
  };
  Node& node(int level, int at_x, int at_z);
  void number(int level, int at_x, int at_z);
  void measure(const GroundGrid&);
  Bounds box(int level, int at_x, int at_z) const;
  void collect(int level, int at_x, int at_z, unsigned planes, const Frustum&, std::vector<Run>&) const;

  PatchGrid cut_;
  float cell_x_, cell_z_;
  std::vector<Level> levels_;  // the patches first, one node last
  std::vector<Node> nodes_;
  std::vector<Place> places_;
  Boxes boxes_;
};

}  // namespace terrabench
