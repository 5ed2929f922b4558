// How closely a representation reproduces the ground it was built from.
#pragma once

#include <cstddef>

#include "representations/representation.h"
#include "terrain/progress.h"
#include "terrain/source.h"

namespace terrabench {

struct Fidelity {
  // Sources with heights: the top of each column against the sample there.
  double rmse = 0, largest_error = 0;  // metres
  std::size_t columns = 0;
  std::size_t lost = 0;  // columns where only one of source and representation has ground
  // Solid sources: samples of a cubic lattice that are solid in both, divided by those solid in either.
  double volume_iou = 0;
  std::size_t samples = 0;
  bool from_heights = true;
  // Whether there was anything to compare: a column with ground in both, or a sample that is solid in either.
  // If not, the errors above are not defined.
  bool compared = false;
};

// Solids are compared at kFidelitySamples lattice points along the longest side: a prime, so that they miss
// the sample points of all structures and test what lies between. O(samples), parallel, the same for any
// thread count.
inline constexpr int kFidelitySamples = 211;
Fidelity measure_fidelity(const Representation&, const TerrainSource&, Progress&);

}  // namespace terrabench
