// Geomipmapping (de Boer, "Fast terrain rendering using geometrical mipmapping", 2000): patches of the grid,
// each drawn at the coarsest level whose error stays below the knob, in pixels.
//
// Where the paper is vague or weaker, this was chosen. The bound is strict for every sample in the frustum,
// from any camera (lod/screen_bound.h); `level_camera` selects the paper's own rule. Neighbours differ by at
// most one level; otherwise the coarser one is refined. It is also refined where the triangles of the seam
// would exceed the bound. All index patterns are uploaded once. `morph`, the paper's trilinear geomipmapping
// (§4), uploads 20 bytes per patch in view and frame (morphing.h).
//
// update() is O(patches in view), about 20 ns per patch, twice that with `morph`, and allocates nothing.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "lod/geomipmap/morphing.h"
#include "lod/geomipmap/patch_errors.h"
#include "lod/geomipmap/patch_patterns.h"
#include "lod/geomipmap/patch_tree.h"
#include "lod/lod.h"
#include "lod/screen_bound.h"

namespace terrabench {

class GeoMipMap : public Lod {
 public:
  struct Options {
    int side = 64;              // cells along a patch's side, a power of two
    bool level_camera = false;  // the paper's rule instead of the strict one
    bool morph = false;         // trilinear
    bool stitch = true;         // false leaves gaps beside coarser patches; for measurements
  };

  // The field must outlive it.
  static std::unique_ptr<Lod> build(const LodGround&, const Parameters&, Progress&);
  static Knob knob() { return {"error", "px", 0.05, 200, 2}; }
  static std::span<const ParameterSpec> parameters();

  GeoMipMap(const Heightfield&, const Options&, Progress&);
  const Frame& update(const View&) override;
  void tune(double pixels) override;
  // Measures the patches again that contain an edited sample.
  void edited(const SampleRect&) override;
  Memory memory() const override;

 private:
  static constexpr std::uint8_t kUnseen = 0;  // in level_, whose levels count from 1

  void begin_frame();
  void allow(const ScreenBound&);
  void choose_levels();
  void fit_neighbours();
  void fit(std::uint32_t fine, std::uint32_t coarse, int side);
  void make_frame();

  GroundGrid grid_;
  Options options_;
  PatchGrid cut_;
  std::array<std::int32_t, 4> offsets_;
  int levels_;
  double pixels_;
  PatchPatterns patterns_;
  PatchTree tree_;
  std::optional<PatchErrors> errors_;  // without `morph`
  std::optional<Morphing> morphing_;   // with `morph`

  std::vector<std::uint8_t> level_;       // by slot: level + 1, or kUnseen, which is finer than any level
  std::vector<std::uint8_t> last_level_;  // by number
  std::vector<std::uint8_t> queued_;      // by slot: whether in queue_
  std::vector<std::uint32_t> number_of_;  // by slot
  std::vector<float> allowed_;            // by number; metres
  std::vector<PatchTree::PatchRange> seen_, last_seen_;
  std::vector<std::uint32_t> queue_;  // slots whose level decreased
  std::vector<Batch> batches_;
  std::vector<PatchMorph> morphs_;
  std::vector<DirtyRange> uploads_, edits_;  // edits_: for the next frame
  Frame frame_;
  bool first_ = true;
};

}  // namespace terrabench
