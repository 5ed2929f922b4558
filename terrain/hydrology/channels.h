// Channels of a flow network (Stuetzle & Franklin 2012, §2.1), and the network as rasters.
#pragma once

#include <cstdint>
#include <vector>

#include "terrain/heightfield.h"
#include "terrain/hydrology/flow.h"

namespace terrabench {

// Pixels with accumulation ≥ tau (τ ≥ 1), upstream before downstream, chain by chain: heads in row-major
// order, each followed downstream to its end or to a pixel with a tributary not yet followed; the last
// tributary to reach a pixel continues from it. O(n). In the paper flows "exceed" τ, which is tau = τ + 1
// here: at τ = 25 on mountains of 400² samples 1.6 % fewer pixels and the same error.
std::vector<std::uint32_t> channel_pixels(const FlowNetwork& network, std::uint32_t tau);

// The network as rasters over the same ground, for write_geotiff(): accumulation (exact up to 2^24 pixels),
// and direction in the powers of two that GIS tools use (E 1, SE 2, S 4 … NE 128, outlets 0).
Heightfield accumulation_raster(const FlowNetwork& network, const Heightfield& ground);
Heightfield direction_raster(const FlowNetwork& network, const Heightfield& ground);

}  // namespace terrabench
