// What figures of grounded heightmap trees draw: the surface with the node of each triangle, and the ground
// planes.
#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "representations/ght/ght.h"
#include "terrain/mesh.h"

namespace terrabench::ght {

struct TreeSurface {
  TriangleMesh mesh;          // with normals; sharp where two nodes meet
  std::vector<NodeId> nodes;  // one per triangle: the latest of its corners' nodes
};
// O(surface)
TreeSurface tree_surface(const Model&);

// Corners of the ground plane of a node, in order: the convex hull of its cells that are not void. Empty for
// fewer than three cells. O(cells of the node)
std::vector<glm::vec3> plane_outline(const Tree&, NodeId);

}  // namespace terrabench::ght
