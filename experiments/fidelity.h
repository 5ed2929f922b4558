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

// `resolution`: lattice samples along the longest side for solids. O(samples), parallel, same result for any
// thread count.
Fidelity measure_fidelity(const Representation&, const TerrainSource&, int resolution, Progress&);

}  // namespace terrabench
