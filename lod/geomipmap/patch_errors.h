// The largest vertical error of each patch at each level, measured at every sample: δ of de Boer (2000,
// §2.3), and the same for the strips of triangles that meet a coarser neighbour, which the paper omits.
//
// δ of a level is the largest error of that level and all finer ones, so refining a patch never violates a
// bound. O(samples · levels) time, in parallel; four numbers per patch and level, and eight per patch.
#pragma once

#include <array>
#include <vector>

#include "lod/geomipmap/patch_patterns.h"
#include "lod/geomipmap/patch_ruler.h"
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

  // Measures these patches again.
  void measure(const GroundGrid&, const PatchGrid&, const PatchTree&, const PatchPatterns&,
               const PatchGrid::PatchRect&);

  // The coarsest level whose error is at most `allowed` metres. `patch`: its number in the tree.
  int coarsest(std::size_t patch, float allowed) const {
    int level = 0;
    for (const float error : errors_[patch]) level += error <= allowed ? 1 : 0;
    return level;
  }
  // The error of the triangles along a side that meets a neighbour of level + 1, metres.
  float of_seam(std::size_t slot, int level, int side) const {
    return seams_[(slot * steps_ + level) * 4 + side];
  }
  Memory memory() const;

 private:
  using Levels = std::array<float, kMostLevels - 1>;  // from level 1 on; infinite beyond the coarsest

  void measure(const PatchRuler&, const PatchTree&, std::size_t patch);

  std::size_t steps_;  // levels - 1
  std::vector<Levels> errors_;
  std::vector<float> seams_;
};

}  // namespace terrabench
