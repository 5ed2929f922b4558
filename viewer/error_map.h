// Errors on the screen as colours on the ground, from the meters that the experiments use (lod/meters).
#pragma once

#include <future>
#include <memory>
#include <optional>

#include "lod/lod.h"
#include "lod/meters/screen_error.h"
#include "terrain/image.h"

namespace terrabench::viewer {

// From white without error over yellow and red to black at `share` 1 and more; lightness falls throughout.
Rgb error_colour(double share);
inline constexpr Rgb kNotSeen{150, 152, 158};  // hidden, out of view or not drawn

struct ErrorMap {
  Image colours;      // a pixel per sample
  Deviation visible;  // pixels
};

// `full`: pixels that have the last colour, > 0. The frame must be one of the ground, for that view.
// O(samples + triangles), in parallel.
ErrorMap map_errors(const SurfaceRaster& drawn, const Heightfield&, const View&, double full);

// Computes maps beside the drawing, one at a time: a map is as old as its computation takes.
class ErrorMapper {
 public:
  ~ErrorMapper() { wait(); }
  bool busy() const { return future_.valid(); }
  // Unless busy. The ground must not change until the map is taken, or wait() was called.
  void start(const Frame&, const Heightfield&, const View&, double full);
  std::optional<ErrorMap> take();  // once it is ready
  void wait();                     // drops what is being computed

 private:
  std::future<ErrorMap> future_;
};

}  // namespace terrabench::viewer
