// Right-triangulated irregular networks (Evans, Kirkpatrick and Townsend, "Right-triangulated irregular
// networks", 2001): triangles are bisected from two per square down, where their error is too large. Nothing
// is kept of the mesh but its indices: each update descends anew from the roots.
//
// A triangle is split while its error, nested and exact (nested_errors.h), may show as more than the knob's
// pixels anywhere in its nested sphere (lod/screen_bound.h), so the knob bounds the error of every sample in
// view. `error=midpoint` takes the published errors instead, those of martini (Agafonkin 2019), which look at
// one sample per triangle and keep no bound. With `metres`, as published, one mesh serves all views:
// triangles are split while their error exceeds so many metres, and the knob has no effect.
//
// update() is O(triangles in view), 0.1 to 0.2 µs each, and allocates only while the mesh grows.
// Uploads all indices from the first on that differs from the last frame's; FrameStats::changes is not
// counted.
#pragma once

#include <vector>

#include "lod/fresh_frame.h"
#include "lod/rtin/nested_errors.h"

namespace terrabench {

class Rtin : public Lod {
 public:
  struct Options {
    bool exact = true;  // false: the published errors
    double metres = 0;  // one mesh for all views; 0: by the view
  };

  // The field must outlive it.
  static std::unique_ptr<Lod> build(const LodGround&, const Parameters&, Progress&);
  static Knob knob() { return {"error", "px", 0.05, 200, 2}; }
  static std::span<const ParameterSpec> parameters();

  Rtin(const Heightfield&, const Options&, Progress&);
  const Frame& update(const View&) override;
  void tune(double pixels) override { pixels_ = setting(knob(), pixels); }
  // Reads the ground under all triangles that contain an edited sample (NestedErrors::update()).
  void edited(const SampleRect&) override;
  Memory memory() const override;

  const rtin::NestedErrors& errors() const { return errors_; }

 private:
  void descend_for(const View&);
  void descend_for_all_views();
  void draw(const rtin::Triangle&);

  Options options_;
  rtin::NestedErrors errors_;
  double pixels_ = knob().fallback;
  FreshFrame frame_;
};

}  // namespace terrabench
