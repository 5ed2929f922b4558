// How far each patch at each level is from the full terrain, measured at every sample: δ of de Boer (2000,
// §2.3), and the same for the strips of triangles that meet a coarser neighbour, which the paper leaves out.
//
// δ never sinks with the level (the greatest of a level and all finer ones), so that whatever a patch is
// refined for, no bound is lost. O(samples · levels) time, in parallel; five numbers a patch and level.
#pragma once

#include <vector>

#include "lod/geomipmap/patch_patterns.h"
#include "terrain/frame.h"
#include "terrain/memory.h"
#include "terrain/progress.h"

namespace terrabench {

class PatchErrors {
 public:
  PatchErrors(const GroundGrid&, const PatchGrid&, const PatchPatterns&, int levels, Progress&);

  // Metres, of a level; 0 at level 0. Patches by slot.
  float of_level(std::size_t slot, int level) const { return levels_[slot * count_ + level]; }
  // Metres, of the triangles along a side that is pulled onto a neighbour of level + 1.
  float of_seam(std::size_t slot, int level, int side) const {
    return seams_[(slot * (count_ - 1) + level) * 4 + side];
  }
  Memory memory() const;

 private:
  std::size_t count_;  // levels
  std::vector<float> levels_, seams_;
};

}  // namespace terrabench
