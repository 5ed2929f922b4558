// The terrains that have a name: real ones read in place from packages, and generated ones. See
// terrain/source.h for terrains() and open_terrain(); these are for tests, tools and ground of other sizes.
#pragma once

#include <string>
#include <string_view>

#include "terrain/source.h"

namespace terrabench {

// GDAL's inline description of an array inside one of matplotlib's sample files, read where Debian installs
// them. Throws environment_error that names the package when the file is not there.
std::string jacksboro_vrt();
std::string topobathy_vrt();

// mirrored_mosaic() of the terrain helens, size × size samples.
inline constexpr std::string_view kHelensMosaic = "helens-mosaic";
TerrainSource open_helens_mosaic(int size);

}  // namespace terrabench
