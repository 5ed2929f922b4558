// The elevation models of terrain/dems, which travel inside the program.
#pragma once

#include <string>
#include <string_view>

namespace terrabench {

// The path in GDAL's file system in memory under which read_dem() reads terrain/dems/NAME.tif. The file must
// exist. The first call makes all of them available; safe to call from several threads at once. O(1).
std::string embedded_dem(std::string_view name);

}  // namespace terrabench
