// What the ranges of CDLOD's levels follow from, measured at every sample: the error of each level's surface
// and of all surfaces into which its vertices may morph, and the heights in its triangles and nodes.
//
// The height of a morphing vertex lies between its sample and the surface of the next coarser level, whatever
// the distance is. So the surface lies between two: one whose vertices have the higher, and one whose
// vertices have the lower of the two heights. The error of these bounds the error of any morph.
//
// The measures are kept for blocks of 64 × 64 samples, or of two cells of coarser levels, so that an edit
// measures only the blocks that hold its samples. O(samples · levels) to build, in parallel; 16 bytes per
// block and level.
#pragma once

#include <algorithm>
#include <vector>

#include "lod/cdlod/node_tree.h"
#include "terrain/progress.h"

namespace terrabench::cdlod {

// The largest of each, metres.
struct Extremes {
  float drawn = 0;    // error of the level's surface
  float morphed = 0;  // error of a surface between it and the next coarser level's; 0 for the coarsest
  float rise = 0;     // the highest less the lowest sample in a triangle
  float relief = 0;   // the same in a node; per level, not per block

  void add(const Extremes& other) {
    drawn = std::max(drawn, other.drawn);
    morphed = std::max(morphed, other.morphed);
    rise = std::max(rise, other.rise);
  }
};

class LevelErrors {
 public:
  // `side`: of the nodes, cells.
  LevelErrors(const GroundGrid&, const NodeTree&, int side, Progress&);

  const Extremes& of(int level) const { return levels_[static_cast<std::size_t>(level)]; }
  // Measures the blocks again that hold these samples; reads all blocks' measures and the reliefs of all
  // nodes, which are measured before.
  void measure(const GroundGrid&, const NodeTree&, const SampleRect&, Progress* = nullptr);
  Memory memory() const { return index_memory(grids_, firsts_, blocks_, levels_); }

 private:
  int side_;
  std::vector<PatchGrid> grids_;  // of the blocks, by level; sides in samples
  std::vector<std::size_t> firsts_;
  std::vector<Extremes> blocks_;  // by level
  std::vector<Extremes> levels_;
};

}  // namespace terrabench::cdlod
