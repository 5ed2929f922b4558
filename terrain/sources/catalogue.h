// Named terrains of a size that the caller chooses. See terrain/source.h for terrains() and open_terrain().
#pragma once

#include <string_view>

#include "terrain/source.h"

namespace terrabench {

// mirrored_mosaic() of the terrain helens, size × size samples.
inline constexpr std::string_view kHelensMosaic = "helens-mosaic";
TerrainSource open_helens_mosaic(int size);

}  // namespace terrabench
