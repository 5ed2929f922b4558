// The edges that a wireframe shows. quad_wires() is declared in scene.h.
#pragma once

#include "renderers/scene.h"

namespace terrabench {

// In SceneMesh::wires, shifted by the edge's number: the edge is an outline. It has a visible surface on one
// side only, so the wire has its full width there.
inline constexpr unsigned kOutlineBit = 1U << 3;

// Marks outlines: wires on open borders, and silhouette edges, where the surface turns away from the eye,
// which also become wires. Empty `wires` means all edges. O(triangles log triangles).
std::vector<std::uint8_t> with_outlines(const TriangleMesh&, std::vector<std::uint8_t> wires,
                                        const glm::vec3& eye);

}  // namespace terrabench
