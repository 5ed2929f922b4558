// The closed block under a grid of heights.
#pragma once

#include <span>

#include "terrain/mesh.h"

namespace terrabench {

// Heights over the lattice x × z (row-major, rows along x), NaN for none. Two triangles for each lattice cell
// with all four heights, the same cells again at `floor`, and walls where a cell has no neighbour. Where two
// cells touch at a corner only, the corner is duplicated, so that each edge belongs to two triangles.
// O(samples), parallel over rows.
TriangleMesh closed_mesh(std::span<const float> x, std::span<const float> z, std::span<const float> heights,
                         float floor);

}  // namespace terrabench
