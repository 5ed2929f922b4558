// The grounds that several papers' experiments measure on.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "experiments/experiment.h"
#include "terrain/source.h"

namespace terrabench {

// The terrains that the options name, or else these.
std::vector<std::string> grounds(const RunOptions&, std::vector<std::string> own);

// open_terrain() for experiments that need heights. Throws usage_error for a solid.
TerrainSource open_heights(std::string_view name, std::uint64_t seed);
TerrainSource open_filled_heights(std::string_view name, std::uint64_t seed);  // without holes

// Height fields of noise, size × size samples, 30 m apart. The largest features are about 4 km wide.
// O(samples), parallel; the same for any thread count.
Heightfield noise_ridges(int size, std::uint64_t seed);  // ridged multifractal
Heightfield noise_hills(int size, std::uint64_t seed);   // fractal Brownian motion
Heightfield whole_metres(Heightfield);                   // rounded, as elevation models are

}  // namespace terrabench
