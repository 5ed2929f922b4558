// What figures of grounded heightmap trees draw: the surface with the node that each triangle belongs to, the
// block of ground under it, ground planes, and a cut through the ground.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "representations/ght/ght.h"
#include "terrain/mesh.h"

namespace terrabench::ght {

struct TreeSurface {
  TriangleMesh mesh;          // with normals; sharp where two nodes meet
  std::vector<NodeId> nodes;  // one a triangle: the latest of its corners' nodes
};
// O(surface).
TreeSurface tree_surface(const Model&);

// An upright plane; what lies on the side of `towards` is cut away.
struct CutPlane {
  glm::vec2 point{0}, towards{0};  // in plan: x, z; `towards` is a unit vector
  float in_front(glm::vec3 p) const { return (p.x - point.x) * towards.x + (p.z - point.y) * towards.y; }
};
// Triangles that the plane crosses are divided; `nodes` follow them. O(triangles).
void cut_away(TriangleMesh&, const CutPlane&, std::vector<NodeId>* nodes = nullptr);
// The solid ground in the plane, in strips `step` metres wide. O(strips).
TriangleMesh section_face(const Ght&, const CutPlane&, float step);

// The four upright sides of the block of ground, from the surface at the terrain's border to the floor.
TriangleMesh block_sides(const Ght&);

// Corners of the ground plane of a node around all its cells that are not void: a convex polygon.
std::vector<glm::vec3> plane_outline(const Tree&, NodeId);

// The part of a mesh that `keep` says, by triangle; vertices stay.
template <class Keep>
TriangleMesh part_of(const TriangleMesh& mesh, const Keep& keep) {
  TriangleMesh part{mesh.positions, mesh.normals, {}};
  for (std::size_t t = 0; t < mesh.triangles(); ++t) {
    if (keep(t)) part.indices.insert(part.indices.end(), &mesh.indices[3 * t], &mesh.indices[3 * t] + 3);
  }
  return part;
}

}  // namespace terrabench::ght
