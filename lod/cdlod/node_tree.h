// The quadtree of CDLOD (Strugar 2009): the lowest and the highest sample of every node, in a pyramid of flat
// arrays. A node of level l has side × side cells of 2^l samples, fewer at the ground's border; its children
// are the nodes (2x, 2z) to (2x + 1, 2z + 1) of level l - 1. The coarsest level has as many nodes as cover
// the ground.
//
// 8 bytes per node; O(samples) to build, in parallel.
#pragma once

#include <vector>

#include "lod/geomipmap/patch_grid.h"
#include "lod/lod.h"
#include "terrain/frame.h"
#include "terrain/memory.h"
#include "terrain/solid.h"

namespace terrabench::cdlod {

// As many levels as one node needs to cover the ground, but with no node of more than `largest` cells a side.
int levels_of(int width, int depth, int side, int largest);

class NodeTree {
 public:
  NodeTree(const GroundGrid&, int side, int levels);
  // Over ground that is not in memory: set_range() gives every node its lowest and highest sample.
  NodeTree(int width, int depth, glm::vec2 cell, int side, int levels);

  int levels() const { return static_cast<int>(grids_.size()); }
  // The nodes of a level; sides and patches are in samples.
  const PatchGrid& grid(int level) const { return grids_[static_cast<std::size_t>(level)]; }
  std::size_t count() const { return ranges_.size(); }
  std::size_t number(int level, int x, int z) const {
    return firsts_[static_cast<std::size_t>(level)] + static_cast<std::size_t>(z) * grid(level).across() +
           static_cast<std::size_t>(x);
  }
  bool has(int level, int x, int z) const {
    return x >= 0 && z >= 0 && x < grid(level).across() && z < grid(level).down();
  }
  Bounds box(int level, int x, int z) const;  // metres
  // The highest less the lowest sample, metres.
  float relief(int level, int x, int z) const {
    const Range& range = ranges_[number(level, x, z)];
    return range.highest - range.lowest;
  }
  void set_range(std::size_t number, float lowest, float highest) { ranges_[number] = {lowest, highest}; }
  // Measures the nodes again that hold these samples. O(samples of these leaves + levels).
  void measure(const GroundGrid&, const SampleRect&);
  Memory memory() const { return index_memory(grids_, firsts_, ranges_); }

 private:
  struct Range {
    float lowest, highest;
  };
  Range measured(const GroundGrid&, const PatchGrid::Patch&) const;

  float cell_x_, cell_z_;
  std::vector<PatchGrid> grids_;     // by level
  std::vector<std::size_t> firsts_;  // number of each level's first node
  std::vector<Range> ranges_;        // by number
};

}  // namespace terrabench::cdlod
