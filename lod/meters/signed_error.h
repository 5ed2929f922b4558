// How far the drawn ground stands above and below the true ground, and what that does to water: over all
// visible samples of any number of frames. O(samples) per frame.
#pragma once

#include <cstddef>

#include "lod/meters/seen_samples.h"
#include "lod/meters/surface_raster.h"

namespace terrabench {

class SignedError {
 public:
  // `water`: height of a level water plane, metres. The ground is drawn together with it.
  explicit SignedError(double water) : water_(water) {}

  // `ground` must be the one that `seen` was made of. Samples where nothing is drawn do not count.
  void add(const SurfaceRaster& drawn, const Heightfield& ground, const SeenSamples& seen);

  std::size_t samples() const { return samples_; }
  // Metres. The two root mean squares are over all samples, with 0 where the ground stands on the other side:
  // the sum of their squares is the square of the unsigned one.
  double above_largest() const { return above_.largest; }
  double below_largest() const { return below_.largest; }
  double above_rms() const { return rms(above_); }
  double below_rms() const { return rms(below_); }
  // Of the samples whose true ground is under water: those that are drawn above it; and the other way round.
  std::size_t under_water() const { return under_water_; }
  std::size_t over_water() const { return samples_ - under_water_; }
  std::size_t poking() const { return poking_; }    // ground pokes through the water
  std::size_t flooded() const { return flooded_; }  // water where the ground is above it

 private:
  struct Side {
    double largest = 0, squares = 0;
  };
  double rms(const Side&) const;

  double water_;
  Side above_, below_;
  std::size_t samples_ = 0, under_water_ = 0, poking_ = 0, flooded_ = 0;
};

}  // namespace terrabench
