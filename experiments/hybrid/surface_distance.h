// How far surfaces lie from each other: the one-sided Hausdorff distance between triangle meshes.
#pragma once

#include "terrain/mesh.h"

namespace terrabench::hybrid {

struct SurfaceDistance {
  // Metres, over the points, not by area. `common`: 99 % of the points are nearer.
  double largest = 0, common = 0, mean = 0;
};

// From the vertices and the triangles' centroids of `from` to the nearest point of a triangle of `to`,
// exactly. Triangles of `to` are filed in cubes of side `cell`, about the length of their edges, metres.
// Neither mesh may be empty. Parallel, the same for any number of threads. O(points of `from` + triangles) if
// the surfaces are close.
SurfaceDistance distance_to(const TriangleMesh& from, const TriangleMesh& to, float cell);

}  // namespace terrabench::hybrid
