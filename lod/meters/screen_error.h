// How far the drawn surface stands from where it should, in pixels of a view: the neutral error and popping
// meters. Distances are between the projections of two points of the same vertical line, at the samples that
// the view sees of the full terrain. O(samples), in parallel; the same for any number of threads.
#pragma once

#include <cstddef>

#include "lod/meters/distribution.h"
#include "lod/meters/seen_samples.h"
#include "lod/meters/surface_raster.h"

namespace terrabench {

// Over the samples where something is drawn; pixels.
struct Deviation {
  double largest = 0, mean = 0;
  double p99 = 0;           // 99 % of the samples deviate by no more
  std::size_t samples = 0;  // measured
  std::size_t undrawn = 0;  // not measured: nothing is drawn there
};

struct ScreenDeviation {
  Deviation visible;     // the samples that nothing hides
  Deviation in_frustum;  // those and the hidden ones, for what is promised whatever is hidden
};

// Between the drawn surface and the full terrain. The ground is the one that `seen` was made of. The visible
// samples' pixels go into `pool` too, when there is one, for percentiles over many frames.
ScreenDeviation screen_error(const SurfaceRaster& drawn, const Heightfield& ground, const SeenSamples& seen,
                             Distribution* pool = nullptr);

// Between two consecutive frames' surfaces, both looked at from the later view, so that the camera's own
// motion does not count: what suddenly moves.
ScreenDeviation popping(const SurfaceRaster& before, const SurfaceRaster& after, const SeenSamples& seen,
                        Distribution* pool = nullptr);

}  // namespace terrabench
