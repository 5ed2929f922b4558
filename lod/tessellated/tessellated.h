// Square patches of the ground that the GPU's tessellator divides, by a factor for each side and one for the
// inside: common practice since OpenGL 4 and Direct3D 11 (Cantlay, "DirectX 11 terrain tessellation", NVIDIA
// 2011). Per frame, 8 bytes for each patch in view are sent and no indices.
//
// A side has one factor, by which both patches beside it divide it, so no cracks open. Factors are powers of
// two with equal spacing: only then are all vertices samples, from whose errors a bound can follow. A
// fractional factor would move vertices between samples, where heights are interpolated and swim as the
// factor changes.
//
// `factor=error` (ours): a side has the fewest segments that keep its error, and that of the strips beside it
// if the insides had its factor, within the knob (lod/screen_bound.h). Then each
// inside has the fewest for which its inner square and four strips keep the knob, by errors
// measured for all combinations (factor_errors.h); with one segment per cell they always do. Without the
// strips' errors, sides come out so coarse that insides must make up for them: 1.6 times as many triangles
// on jacksboro at 2 px with patches of 32 cells. `factor=length`: as in practice, a side has so many segments
// that none can be longer on the screen than the knob, however it is turned, and the inside as many as the
// finest side; errors are ignored.
//
// What OpenGL leaves to the implementation, patch_triangles.h says; what a patch is measured to draw is what
// Direct3D's rules give. Every OpenGL that renderers/context.h opens (4.5) has a tessellator.
//
// To follow a frame: update(), factors() for a patch, factor_of() for a side. update(): O(patches in view),
// 0.1 to 0.3 µs each (tests/bench/tessellated_bench).
#pragma once

#include <vector>

#include "lod/geomipmap/patch_tree.h"
#include "lod/lod.h"
#include "lod/screen_bound.h"
#include "lod/tessellated/factor_errors.h"
#include "lod/tessellated/patch_triangles.h"

namespace terrabench {

class Tessellated : public Lod {
 public:
  struct Options {
    int side = 16;         // cells along a patch's side, a power of two, 4 to 64
    bool by_error = true;  // false: by the sides' lengths on the screen
  };

  // The field must outlive it.
  static std::unique_ptr<Lod> build(const LodGround&, const Parameters&, Progress&);
  static Knob knob() { return {"error", "px", 0.05, 200, 2}; }
  static std::span<const ParameterSpec> parameters();

  Tessellated(const Heightfield&, const Options&, Progress&);
  const Frame& update(const View&) override;
  void tune(double pixels) override { pixels_ = setting(knob(), pixels); }
  // Measures the patches again that contain an edited sample.
  void edited(const SampleRect&) override;
  Memory memory() const override;

 private:
  void begin_frame();
  std::uint32_t factors(std::uint32_t number, const ScreenBound&);
  int factor_of(std::size_t side, const ScreenBound&);
  int choose_factor(std::size_t side, const ScreenBound&) const;
  bool keeps_bound(std::uint32_t slot, std::uint32_t factors, int inside, float allowed) const;
  void make_frame(std::size_t changes);

  GroundGrid grid_;
  Options options_;
  double pixels_;
  PatchGrid cut_;
  PatchTree tree_;
  tessellated::PatchTriangles triangles_;
  tessellated::FactorErrors errors_;
  std::vector<float> allowed_;                         // by number; metres
  std::vector<std::uint8_t> side_factors_;             // logarithms, by side; kUnknown: not chosen yet
  std::vector<std::uint32_t> factors_, last_factors_;  // by number; 0: not in view
  std::vector<PatchTree::PatchRange> seen_, last_seen_;
  std::vector<TessellatedPatch> patches_;
  std::vector<Batch> batches_;
  std::vector<DirtyRange> uploads_, edits_;  // edits_: for the next frame
  Frame frame_;
  bool first_ = true;
};

}  // namespace terrabench
