// A path-traced picture of a scene whose parts are expanded on demand, by the same light as
// RaytracedPicture's. Tile by tile, all paths advance together: the rays of each bounce are one batch
// (part_queries.h). Its pixels depend on the scene, the view and the settings alone: not on threads, on the
// size of tiles, or on which parts are in memory.
#pragma once

#include "renderers/raytrace/coherent/part_queries.h"
#include "terrain/image.h"
#include "terrain/view.h"

namespace terrabench {

struct CoherentSettings {
  int samples = 8;  // per pixel, 1 to 65536
  int bounces = 1;  // 0 to 64
  std::uint32_t seed = 1;
  int tile = 64;  // pixels along the sides of a tile, 1 to 4096; a path in flight takes about 500 bytes
};

struct CoherentPicture {
  int width = 0, height = 0;
  std::vector<glm::vec3> radiance;     // per pixel, rows from top to bottom
  std::vector<std::uint32_t> objects;  // the part that the first sample sees, plus 1; 0 for the sky
  Image image() const;
};

// Throws usage_error for settings and views out of range, bad_input for radiance that is not finite, and what
// PartQueries throws. O(pixels · samples · bounces) rays.
CoherentPicture trace_coherent(const PartScene&, const View&, const CoherentSettings& = {},
                               Progress* = nullptr);

}  // namespace terrabench
