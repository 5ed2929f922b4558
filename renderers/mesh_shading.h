// What the light of relief pictures takes from a mesh as a whole.
#pragma once

#include <vector>

#include "terrain/mesh.h"

namespace terrabench {

// How hollow (below 0) or rounded (above) the surface is around each vertex, as the share by which to change
// its light: valleys darken and ridges lighten, as if they saw less or more of the sky. The bend of normals
// along edges, averaged over neighbours twice for a softer line. The mesh has normals. O(triangles).
std::vector<float> curvature_shading(const TriangleMesh&);

// The factor by which slopes are steepened for the light: what brings the mean slope of the ground up to that
// of a lively hill. Walls and ceilings do not count. O(triangles).
float choose_exaggeration(const TriangleMesh&);

}  // namespace terrabench
