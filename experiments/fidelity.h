// How well a representation gives back the ground that it was built from.
#pragma once

#include <cstddef>

#include "representations/representation.h"
#include "terrain/progress.h"
#include "terrain/source.h"

namespace terrabench {

struct Fidelity {
  // Heightfield sources: the top of each column against the sample there.
  double rmse = 0, largest_error = 0;  // metres
  std::size_t columns = 0,
              lost = 0;  // lost: the source has a height and the representation nothing, or the reverse
  // Solid sources: samples on a cubic lattice that are solid in both, over those solid in either.
  double volume_iou = 0;
  std::size_t samples = 0;
  bool from_heights = true;
};

// Solids are compared at kFidelitySamples lattice points along the longest side: a prime, so that they fall
// on no structure's own sample points and see what lies between them. O(samples), parallel, the same for any
// thread count.
inline constexpr int kFidelitySamples = 211;
Fidelity measure_fidelity(const Representation&, const TerrainSource&, Progress&);

}  // namespace terrabench
