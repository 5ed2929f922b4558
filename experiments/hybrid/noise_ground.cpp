#include "experiments/hybrid/noise_ground.h"

#include "terrain/files.h"
#include "terrain/sources/noise/cave_terrain.h"

namespace terrabench::hybrid {

TerrainSource wide_ground(const WideGround& wide) {
  TerrainSource source = noise::cave_source({.seed = wide.seed, .extent = wide.cube});
  // The graph is defined everywhere; only the bounds cut it.
  Bounds& box = source.solid->bounds;
  box.high.x = box.high.z = wide.cube * static_cast<float>(wide.cubes);
  source.name = "caves, side by side";
  source.checksum = source.solid->checksum = checksum(source.checksum + " × " + std::to_string(wide.cubes));
  return source;
}

}  // namespace terrabench::hybrid
