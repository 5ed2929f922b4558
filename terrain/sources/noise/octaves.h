// The octaves of a fractal: frequencies and weights, and the seeds and offsets drawn from its seed.
#pragma once

#include <vector>

#include "terrain/sources/noise/code.h"
#include "terrain/sources/noise/graph.h"

namespace terrabench::noise {

std::vector<Octave> octaves(const Fractal& fractal);

}  // namespace terrabench::noise
