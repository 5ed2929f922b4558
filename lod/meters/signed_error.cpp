#include "lod/meters/signed_error.h"

#include <algorithm>
#include <cmath>

namespace terrabench {

void SignedError::add(const SurfaceRaster& drawn, const Heightfield& ground, const SeenSamples& seen) {
  for (int j = 0; j < seen.depth(); ++j) {
    for (int i = 0; i < seen.width(); ++i) {
      if (seen.at(i, j) != Seen::kVisible || !drawn.is_drawn(i, j)) continue;
      const auto shown = static_cast<double>(drawn.at(i, j)), real = static_cast<double>(ground.at(i, j));
      const double over = shown - real;
      Side& side = over > 0 ? above_ : below_;
      side.largest = std::max(side.largest, std::abs(over));
      side.squares += over * over;
      ++samples_;
      // Ground at the water's own height is under water, in both.
      const bool is_under = real <= water_;
      under_water_ += is_under ? 1 : 0;
      poking_ += is_under && shown > water_ ? 1 : 0;
      flooded_ += !is_under && shown <= water_ ? 1 : 0;
    }
  }
}

double SignedError::rms(const Side& side) const {
  return samples_ == 0 ? 0 : std::sqrt(side.squares / static_cast<double>(samples_));
}

}  // namespace terrabench
