// Lighting parameters of relief pictures that depend on the whole mesh.
#pragma once

#include <vector>

#include "terrain/mesh.h"

namespace terrabench {

// Per vertex, the relative change of light by curvature: negative where the surface is concave, positive
// where it is convex, so that valleys darken and ridges lighten as if they saw less or more of the sky.
// Curvature is the change of normals along edges, smoothed twice over neighbours. The mesh must have normals.
// O(triangles).
std::vector<float> curvature_shading(const TriangleMesh&);

// The factor by which slopes are steepened for the light: raises the mean slope of the ground to 0.45, by a
// factor of 1 to 8. Walls and ceilings do not count. O(triangles).
float choose_exaggeration(const TriangleMesh&);

}  // namespace terrabench
