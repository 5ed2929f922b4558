#include "experiments/hybrid/cave_source.h"

namespace terrabench::hybrid {

TerrainSource cave_source(const noise::CaveOptions& options) {
  TerrainSource source;
  source.name = "caves";
  source.solid = noise::cave_terrain(options);
  source.checksum = source.solid->checksum;
  return source;
}

std::unique_ptr<Representation> build_at_resolution(std::string_view name, const TerrainSource& source,
                                                    std::int64_t n, Progress& progress) {
  const RepresentationType& type = representation(name);
  Parameters parameters(type.parameters);
  parameters.set("resolution", n);
  return type.build(source, parameters, progress);
}

}  // namespace terrabench::hybrid
