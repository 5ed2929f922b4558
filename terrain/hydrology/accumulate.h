// Flow accumulation over D8 directions: how many pixels drain through each.
#pragma once

#include <cstdint>
#include <vector>

#include "terrain/hydrology/flow.h"

namespace terrabench::hydrology {

// From network.direction alone, which must not run in circles. O(n), parallel, the same for any number of
// threads.
std::vector<std::uint32_t> accumulate(const FlowNetwork& network);

}  // namespace terrabench::hydrology
