// The grounds that experiments of "hybrid" share.
#pragma once

#include <cstdint>

#include "terrain/heightfield.h"
#include "terrain/mesh.h"
#include "terrain/source.h"

namespace terrabench::hybrid {

// The paper's noise terrain as a wide landscape, with overhangs and caves: the same graph over several of its
// cubes side by side.
struct WideGround {
  std::uint64_t seed = 1;
  float cube = 256;  // metres, side of the graph's cube: features scale with it
  int cubes = 6;     // along both sides
};
TerrainSource wide_ground(const WideGround&);

// For grass: plateaus, hills and cliffs from fractal noise. A square of 64 m with cells × cells cells, each
// of two triangles. `cliffs` from 0 (hills only) to 1 (terraces with cliffs that are nearly upright) decides
// how the height of the noise is distorted. The same heights for the same seed and place, whatever the number
// of cells. O(cells²).
Heightfield grassland(std::uint64_t seed, int cells, float cliffs);
// With normals, and with x and z moved by 100 m: at the origin the paper's random numbers are all 0.
TriangleMesh grassland_mesh(const Heightfield&);

// The largest difference in height of neighbouring samples, metres.
double largest_step(const Heightfield&);

}  // namespace terrabench::hybrid
