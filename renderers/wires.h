// Which edges a wireframe shows. quad_wires() is declared in scene.h.
#pragma once

#include "renderers/scene.h"

namespace terrabench {

// Added to SceneMesh::wires three bits above an edge's own: the edge is an outline, which has a surface on
// one side only and is drawn in its full width there.
inline constexpr unsigned kOutlineBit = 1U << 3;

// Marks outlines: open borders, where they are wires, and edges at which the surface turns away from the
// eye, which become wires if they were none. Empty `wires` stand for all edges. O(triangles log
// triangles).
std::vector<std::uint8_t> with_outlines(const TriangleMesh&, std::vector<std::uint8_t> wires,
                                        const glm::vec3& eye);

}  // namespace terrabench
