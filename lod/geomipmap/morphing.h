// Trilinear geomipmapping (de Boer 2000, §4): patches morph between levels instead of popping, within the
// bound and without cracks.
//
// A patch has a level with a fraction, a + f: it draws level a's triangles, with the vertices that level a +
// 1 drops moved the share f of the way to the surface of a + 1 (PatchMorph). The error of a blend is at most
// the blend of the errors. So for δ(a) ≤ E < δ(a+1), where E is the error that the bound allows in metres,
// the fraction f = (E - δ(a)) / (δ(a+1) - δ(a)) gives the error (1-f)·δ(a) + f·δ(a+1) = E. The paper's
// fraction is linear in the distance; this one is a strict bound, and needs no finer levels.
//
// A side that two patches share has the level of the coarser patch, fraction included, in both. The finer
// patch is at most one level finer, and its error along that side must keep the bound too. In its first row
// of cells at the side, let the error be s0 at level a and s1 with only the side at a + 1. In its first two
// rows, let it be t1 with only the side at a + 1, t2 with only the side at a + 2, and s2 with everything at a
// + 1. Heights are affine in f and in the side's fraction g, so
//   error ≤ (1-g)·s0 + (g-f)·s1 + f·s2                            with the side at a + g, f ≤ g ≤ 1, and
//   error ≤ (1-g)·[(1-f)·t1 + f·s2] + g·[(1-f)·t2 + f·s1(a+1)]    with the side at a + 1 + g,
// which limits the side's level; the neighbour's level is lowered to it. All levels are continuous in E, so
// nothing pops, except beside patches that come into view and in patches cut by the ground's border: their
// last cells are narrower, and no coarser edge passes through the middles of their edges.
//
// choose(): O(patches in view). 21 numbers per patch and level.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "lod/geomipmap/patch_patterns.h"
#include "lod/geomipmap/patch_ruler.h"
#include "lod/geomipmap/patch_tree.h"
#include "terrain/frame.h"
#include "terrain/memory.h"
#include "terrain/progress.h"

namespace terrabench {

class Morphing {
 public:
  // The patterns must be made with Split::kThroughOdd. O(samples · levels) time, in parallel.
  Morphing(const GroundGrid&, const PatchGrid&, const PatchPatterns&, int levels, Progress&);

  // Measures these patches again.
  void measure(const GroundGrid&, const PatchGrid&, const PatchPatterns&, const PatchGrid::PatchRect&,
               Progress* = nullptr);

  // Chooses levels for the patches in view, `seen`; the error of patch k may be allowed[k] metres. Patches
  // out of view count as finer than all others. `last_seen`: the patches of the previous call.
  void choose(std::span<const PatchTree::Place>, std::span<const PatchTree::PatchRange> last_seen,
              std::span<const PatchTree::PatchRange> seen, std::span<const float> allowed);
  // The level, without fraction, of a patch in view.
  int level(std::uint32_t slot) const { return static_cast<int>(level_[slot]); }
  PatchMorph morph(std::uint32_t slot) const;
  Memory memory() const;

 private:
  static constexpr float kUnseen = -1;
  struct Strip {
    // s0, s1, s2, t1, t2, metres. The last is infinite in cut patches, whose sides never get so coarse.
    float fine, side_coarse, coarse, wide_side_coarse, wide_side_coarser;
  };

  void measure(PatchRuler&, std::uint32_t slot);
  void measure_strips(PatchRuler&, int level, Strip* strips) const;
  float own_level(std::uint32_t slot) const;
  float coarsest_side(std::uint32_t slot, int side) const;
  void fit_neighbours(std::uint32_t slot);

  float error(std::uint32_t slot, int level) const {
    return errors_[slot * static_cast<std::size_t>(levels_) + static_cast<std::size_t>(level)];
  }
  const Strip& strip(std::uint32_t slot, int level, int side) const {
    return strips_[(slot * static_cast<std::size_t>(levels_ - 1) + static_cast<std::size_t>(level)) * 4 +
                   static_cast<std::size_t>(side)];
  }

  std::array<std::int32_t, 4> offsets_;
  int levels_;
  // By slot.
  std::vector<float> errors_;    // δ, by level; at least kLeastRise times the finer level's
  std::vector<Strip> strips_;    // by level and side
  std::vector<float> rounding_;  // of heights, metres
  std::vector<float> allowed_;   // metres, less the rounding
  std::vector<float> level_;     // with fraction, or kUnseen
  std::vector<std::uint8_t> queued_;
  std::vector<std::uint32_t> queue_;  // slots
};

}  // namespace terrabench
