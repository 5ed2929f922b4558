// Screen-space error and popping of the drawn surface, in pixels of a view, for any method. At each sample of
// the full terrain in view, measures the distance between the projections of two points on its vertical line.
// O(samples), in parallel; the result does not depend on the number of threads.
#pragma once

#include <cstddef>

#include "lod/meters/distribution.h"
#include "lod/meters/seen_samples.h"
#include "lod/meters/surface_raster.h"

namespace terrabench {

// Over the samples where something is drawn, pixels.
struct Deviation {
  double largest = 0, mean = 0;
  double p99 = 0;           // 99 % of the samples deviate by at most this
  std::size_t samples = 0;  // measured
  std::size_t undrawn = 0;  // not measured, because nothing is drawn there
};

struct ScreenDeviation {
  Deviation visible;     // samples that are not hidden
  Deviation in_frustum;  // all samples in the frustum, for bounds that ignore occlusion
};

// Between the drawn surface and the full terrain. `ground` must be the one that `seen` was made of. `pool`,
// if not null, also receives the visible samples' deviations, for percentiles over many frames.
ScreenDeviation screen_error(const SurfaceRaster& drawn, const Heightfield& ground, const SeenSamples& seen,
                             Distribution* pool = nullptr);

// Between the surfaces of two consecutive frames, both in the later view, so that only changes of the surface
// count and not the camera's motion.
ScreenDeviation popping(const SurfaceRaster& before, const SurfaceRaster& after, const SeenSamples& seen,
                        Distribution* pool = nullptr);

}  // namespace terrabench
