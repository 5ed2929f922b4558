// How far each patch at each level is from the full terrain, measured at every sample: δ of de Boer (2000,
// §2.3), and the same for the strips of triangles that meet a coarser neighbour, which the paper leaves out.
//
// δ never sinks with the level (the greatest of a level and all finer ones), so that whatever a patch is
// refined for, no bound is lost. O(samples · levels) time, in parallel; four numbers a patch and level, and
// eight a patch.
#pragma once

#include <array>
#include <vector>

#include "lod/geomipmap/patch_patterns.h"
#include "lod/geomipmap/patch_tree.h"
#include "terrain/frame.h"
#include "terrain/memory.h"
#include "terrain/progress.h"

namespace terrabench {

class PatchErrors {
 public:
  static constexpr std::size_t kMostLevels = 9;

  PatchErrors(const GroundGrid&, const PatchGrid&, const PatchTree&, const PatchPatterns&, int levels,
              Progress&);

  // The coarsest level whose error is at most `allowed` metres. The patch by its number in the tree.
  int coarsest(std::size_t patch, float allowed) const {
    int level = 0;
    for (const float error : errors_[patch]) level += error <= allowed ? 1 : 0;
    return level;
  }
  // Metres, of the triangles along a side that is pulled onto a neighbour of level + 1. The patch by its
  // slot.
  float of_seam(std::size_t slot, int level, int side) const {
    return seams_[(slot * steps_ + level) * 4 + side];
  }
  Memory memory() const;

 private:
  using Levels = std::array<float, kMostLevels - 1>;  // from level 1 on; those that there are not, infinite

  std::size_t steps_;  // from level to level
  std::vector<Levels> errors_;
  std::vector<float> seams_;
};

}  // namespace terrabench
