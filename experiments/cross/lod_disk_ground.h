// Mountains as large as a disk holds, made a row of tiles at a time.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "terrain/progress.h"

namespace terrabench::cross {

// side × side samples, 30 m apart, of diamond-square ground in whole metres, as SRTM has them. Returns a
// digest of what determines every height. O(side²), in parallel; memory: a grid of 4097², and a row of tiles.
std::string write_disk_ground(const std::filesystem::path&, int side, std::uint64_t seed, Progress&);

}  // namespace terrabench::cross
