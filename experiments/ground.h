// The grounds that several papers' experiments measure on.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "experiments/experiment.h"
#include "terrain/source.h"
#include "terrain/sources/noise/graph.h"

namespace terrabench {

// The terrains that the options name, or else these.
std::vector<std::string> grounds(const RunOptions&, std::vector<std::string> own);

// open_terrain() for experiments that need heights. Throws usage_error for a solid.
TerrainSource open_heights(std::string_view name, std::uint64_t seed);
TerrainSource open_filled_heights(std::string_view name, std::uint64_t seed);  // without holes

// A height field of size × size samples, `cell` metres apart: lift + relief · noise, metres. O(samples),
// parallel; the same for any thread count.
Heightfield noise_heights(const noise::Graph&, noise::Node root, int size, float cell, float lift = 0,
                          float relief = 1);
// 30 m apart. The largest features are about 4 km wide.
Heightfield noise_ridges(int size, std::uint64_t seed);  // ridged multifractal
Heightfield noise_hills(int size, std::uint64_t seed);   // fractal Brownian motion
Heightfield whole_metres(Heightfield);                   // rounded, as elevation models are

}  // namespace terrabench
