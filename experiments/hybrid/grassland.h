// The ground that the grass experiments of "hybrid" share: plateaus, hills and cliffs from fractal noise.
#pragma once

#include <cstdint>

#include "terrain/heightfield.h"
#include "terrain/mesh.h"

namespace terrabench::hybrid {

// A square of 64 m with cells × cells cells, each of two triangles. `cliffs` from 0 (hills only) to 1
// (terraces with cliffs that are nearly upright) decides how the height of the noise is distorted. The same
// heights for the same seed and place, whatever the number of cells. O(cells²).
inline constexpr float kGrasslandMetres = 64;
Heightfield grassland(std::uint64_t seed, int cells, float cliffs);

// With normals, and with x and z moved by 100 m: at the origin the paper's random numbers are all 0.
TriangleMesh grassland_mesh(const Heightfield&);

}  // namespace terrabench::hybrid
