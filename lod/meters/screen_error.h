// Screen-space error and popping of the drawn surface, in pixels of a view, for any method. At each sample of
// the full terrain in view, measures the distance between the projections of two points on its vertical line.
// O(samples), in parallel; the result does not depend on the number of threads.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "lod/meters/seen_samples.h"
#include "lod/meters/surface_raster.h"

namespace terrabench {

// A histogram of the samples' deviations in pixels over any number of frames, for percentiles over a whole
// path. Bins are 1/256 octave wide; memory is half a megabyte for any path. The order of adding does not
// matter. O(1) per sample.
class Distribution {
 public:
  void add(std::span<const float> pixels);  // ≥ 0

  std::uint64_t samples() const { return samples_; }
  double mean() const { return samples_ == 0 ? 0 : sum_ / static_cast<double>(samples_); }
  double rms() const { return samples_ == 0 ? 0 : std::sqrt(squares_ / static_cast<double>(samples_)); }
  double largest() const { return static_cast<double>(largest_); }
  // `share` of the samples, 0 to 1, are at most this value; exact or up to 0.4 % too high. 0 without samples.
  double quantile(double share) const;

 private:
  static constexpr int kShift = 15;  // leaves the exponent and eight bits of the mantissa
  std::vector<std::uint64_t> counts_ = std::vector<std::uint64_t>((0x7F800000U >> kShift) + 1);
  std::uint64_t samples_ = 0;
  double sum_ = 0, squares_ = 0;
  float largest_ = 0;
};

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

// The errors that screen_error() sums up, one per sample of the ground, row by row: NaN where the sample is
// hidden or out of view, or nothing is drawn.
std::vector<float> visible_errors(const SurfaceRaster& drawn, const Heightfield& ground, const SeenSamples&);

// Between the surfaces of two consecutive frames, both in the later view, so that only changes of the surface
// count and not the camera's motion.
ScreenDeviation popping(const SurfaceRaster& before, const SurfaceRaster& after, const SeenSamples& seen,
                        Distribution* pool = nullptr);

}  // namespace terrabench
