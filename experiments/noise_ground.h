// Height fields of noise that several papers' experiments measure on: size × size samples, 30 m apart. The
// largest features are about 4 km wide. O(samples), parallel; the same for any thread count.
#pragma once

#include <cstdint>

#include "terrain/heightfield.h"

namespace terrabench {

Heightfield noise_ridges(int size, std::uint64_t seed);  // ridged multifractal
Heightfield noise_hills(int size, std::uint64_t seed);   // fractal Brownian motion
Heightfield whole_metres(Heightfield);                   // rounded, as elevation models are

}  // namespace terrabench
