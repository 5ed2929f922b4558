// The ground of all experiments of "hybrid", and how its structures are built.
#pragma once

#include <memory>
#include <string_view>

#include "representations/representation.h"
#include "terrain/sources/noise/cave_terrain.h"

namespace terrabench::hybrid {

TerrainSource cave_source(const noise::CaveOptions& options);

// The named representation with its parameter "resolution" set to n.
std::unique_ptr<Representation> build_at_resolution(std::string_view name, const TerrainSource& source,
                                                    std::int64_t n, Progress& progress);

}  // namespace terrabench::hybrid
