// Root mean square of the height differences of two terrains, pixel by pixel (Stuetzle & Franklin 2012,
// equation 2), and as a share of the original's elevation range (§3.1). O(n), parallel, the same sum for any
// number of threads.
#pragma once

#include <cstddef>

#include "terrain/heightfield.h"

namespace terrabench {

struct ElevationError {
  double rmse = 0, largest = 0;  // metres
  double range = 0;              // metres between the original's lowest and highest sample
  std::size_t pixels = 0;        // pixels compared: both hold a height
  std::size_t unmatched = 0;     // pixels where only one holds a height

  // rmse / range; of a flat original 0 when it is met exactly, otherwise infinite.
  double normalised() const;
};

// Throws usage_error when the sizes differ.
ElevationError elevation_error(const Heightfield& original, const Heightfield& other);

}  // namespace terrabench
