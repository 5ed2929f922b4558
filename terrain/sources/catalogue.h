// The terrains that have a name: real ones read in place from packages, and generated ones. See
// terrain/source.h for terrains() and open_terrain(); these are for tests and tools.
#pragma once

#include <string>

namespace terrabench {

// GDAL's inline description of an array inside one of matplotlib's sample files, read where Debian installs
// them. Throws environment_error that names the package when the file is not there.
std::string jacksboro_vrt();
std::string topobathy_vrt();

}  // namespace terrabench
