// The grounds on which cross.representations compares all types, and what is read from them once.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "experiments/cross/representations/ground_lines.h"
#include "experiments/experiment.h"
#include "experiments/refusals.h"
#include "representations/representation.h"
#include "terrain/progress.h"
#include "terrain/source.h"

namespace terrabench::cross {

struct SceneOptions {
  std::string terrain;  // fractal, sequence, maine (its middle), or what open_terrain() takes
  int size = 257;       // samples along the fractal; 2^n + 1
  int resolution = 64;  // columns along a solid, the same for all types
  int lines = 101;      // of ground_lines()
  std::uint64_t seed = 1;
  bool operator==(const SceneOptions&) const = default;
};

struct Scene {
  SceneOptions options;
  TerrainSource source;
  GroundLines lines;
  GroundLines random;               // random_lines() of a solid
  std::size_t heightmap_bytes = 0;  // of the ground as a heightmap in memory, at the scene's resolution
  float cell = 1;                   // metres between columns at that resolution

  // For so many columns along the ground; 0: those of the scene, the same for all types. The tree of a
  // sculpture has its samples at the corners of the columns, one more along each side, and for 0 its own.
  Parameters parameters(const RepresentationType&, std::int64_t columns = 0) const;
  std::unique_ptr<Representation> build(const RepresentationType&, Progress&) const;
};

// Metres from the lowest to the highest top of the ground's columns: samples of heights, lines of a solid.
double relief_of(const Scene&);

// The grounds on which types are compared, those that the user names or our own, and the columns along solid
// ground.
std::vector<std::string> compared_scenes(const RunOptions&);
std::int64_t solid_resolution(std::string_view terrain, bool paper_profile);
// Whether the ground is a solid, by its name. A script of events is read for it.
bool is_solid(const std::string& terrain);

// Kept until another one is asked for.
const Scene& scene(const SceneOptions&, Progress&);

// Bytes of the uncompressed ground: 16-bit samples if all heights are whole metres in their range, else
// floats; for a solid, the heights of its columns as floats.
double own_bytes(const Scene&);

}  // namespace terrabench::cross
