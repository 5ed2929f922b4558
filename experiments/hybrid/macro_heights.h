// Measures of the far ground's height map (§3.5 of "hybrid").
#pragma once

#include "terrain/heightfield.h"

namespace terrabench::hybrid {

// The largest difference in height of neighbouring samples, metres.
double largest_step(const Heightfield&);

}  // namespace terrabench::hybrid
