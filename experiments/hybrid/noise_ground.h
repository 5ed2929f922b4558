// The hybrid paper's noise terrain as a wide landscape: the same graph over several of its cubes side by
// side.
#pragma once

#include <cstdint>

#include "terrain/heightfield.h"
#include "terrain/progress.h"
#include "terrain/source.h"

namespace terrabench::hybrid {

struct WideGround {
  std::uint64_t seed = 1;
  float cube = 256;  // metres, side of the graph's cube: features scale with it
  int cubes = 6;     // along both sides
};

// The solid, with overhangs and caves.
TerrainSource wide_ground(const WideGround&);

}  // namespace terrabench::hybrid
