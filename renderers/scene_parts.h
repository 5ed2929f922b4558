// What render_scene() is made of, each in a source of its own.
#pragma once

#include <glm/mat4x4.hpp>
#include <vector>

#include "renderers/scene.h"

namespace terrabench {

// wires.cpp: the edges that a wireframe shows.
// In SceneMesh::wires, shifted by the edge's number: the edge is an outline. It has a visible surface on one
// side only, so the wire has its full width there.
inline constexpr unsigned kOutlineBit = 1U << 3;

// Marks outlines: wires on open borders, and silhouette edges, where the surface turns away from the eye,
// which also become wires. Empty `wires` means all edges. O(triangles log triangles).
std::vector<std::uint8_t> with_outlines(const TriangleMesh&, std::vector<std::uint8_t> wires,
                                        const glm::vec3& eye);

// mesh_shading.cpp: lighting parameters that depend on the whole mesh.
// Per vertex, the relative change of light by curvature: negative where the surface is concave, positive
// where it is convex, so that valleys darken and ridges lighten as if they saw less or more of the sky.
// Curvature is the change of normals along edges, smoothed twice over neighbours. The mesh must have normals.
// O(triangles).
std::vector<float> curvature_shading(const TriangleMesh&);

// The factor by which slopes are steepened for the light: raises the mean slope of the ground to 0.45, by a
// factor of 1 to 8. Walls and ceilings do not count. O(triangles).
float choose_exaggeration(const TriangleMesh&);

// overlay.cpp: planes and lines, drawn over the meshes and hidden behind them.
// Draws planes from back to front, for blending, then lines. Clips at the near plane. Depth testing must be
// on. O(corners + planes log planes).
void draw_overlay(const Scene&, const View&, const glm::mat4& world_to_clip);

}  // namespace terrabench
