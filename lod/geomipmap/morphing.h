// Trilinear geomipmapping (de Boer 2000, §4): patches glide from level to level instead of popping, and keep
// the bound, and no border opens.
//
// A patch stands at a level with a fraction, a + f: level a's triangles, with the vertices that a + 1 drops
// the share f of the way to its surface (PatchMorph). A blend's error is at most the blend of the errors, so
// f = (E - δ(a)) / (δ(a+1) - δ(a)), for δ(a) ≤ E < δ(a+1), keeps (1-f)·δ(a) + f·δ(a+1) = E, the metres that
// the bound allows: the paper's fraction, distance between two switching distances, and strict. No level is
// finer for it.
//
// A border that two patches share stands at the coarser's level with fraction, on both sides. The finer patch
// has no more than one level less, and its error along that side must keep the bound too. Let its first row
// of cells there have the error s0 at level a and s1 with the side alone at a + 1, its first two rows t1 with
// the side alone at a + 1, t2 with the side alone at a + 2, and s2 with all at a + 1. Heights are affine in f
// and in the side's fraction g each, so that
//   error ≤ (1-g)·s0 + (g-f)·s1 + f·s2                            with the side at a + g, f ≤ g ≤ 1, and
//   error ≤ (1-g)·[(1-f)·t1 + f·s2] + g·[(1-f)·t2 + f·s1(a+1)]    with the side at a + 1 + g,
// from which the most that the side may have follows; the neighbour sinks to that. All is continuous in what
// is allowed, so nothing pops, but beside patches that come into view and in patches that the ground's border
// cuts: their last cells are narrower, and no coarser edge passes their middles.
//
// choose(): O(patches in view). 21 numbers a patch and level.
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
  // The patterns must be split through the odd vertices. O(samples · levels) time, in parallel.
  Morphing(const GroundGrid&, const PatchGrid&, const PatchPatterns&, int levels, Progress&);

  // Chooses for the patches in view, runs of places, of which patch k may be off by allowed[k] metres.
  // Patches out of view count as finer than all; `last_seen` are forgotten.
  void choose(std::span<const PatchTree::Place>, std::span<const PatchTree::Run> last_seen,
              std::span<const PatchTree::Run> seen, std::span<const float> allowed);
  // Of a patch in view.
  int level(std::uint32_t slot) const { return static_cast<int>(at_[slot]); }
  PatchMorph morph(std::uint32_t slot) const;
  Memory memory() const;

 private:
  static constexpr float kUnseen = -1;
  struct Strip {
    // Metres: s0, s1, s2, t1, t2. No side of a cut patch comes to the last, which is infinite there.
    float fine, side_coarse, coarse, wide_side_coarse, wide_side_coarser;
  };

  void measure(PatchRuler&, std::uint32_t slot);
  void measure_strips(PatchRuler&, int level, Strip* strips) const;
  float own(std::uint32_t slot) const;
  float most(std::uint32_t slot, int side) const;
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
  std::vector<float> errors_;    // δ, by level; a share more than a finer level's at least
  std::vector<Strip> strips_;    // by level and side
  std::vector<float> rounding_;  // metres that heights are off by
  std::vector<float> allowed_;   // metres, less what rounding may add
  std::vector<float> at_;        // level with fraction, or kUnseen
  std::vector<std::uint8_t> queued_;
  std::vector<std::uint32_t> queue_;  // slots
};

}  // namespace terrabench
