// Ground cut open along upright planes, to show what lies inside.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "representations/representation.h"
#include "terrain/mesh.h"

namespace terrabench::figures {

// An upright plane. The ground on the side to which `towards` points is cut away.
struct CutPlane {
  glm::vec2 point{0}, towards{0};  // in plan: x, z; `towards` is a unit vector
  float in_front(glm::vec3 p) const { return (p.x - point.x) * towards.x + (p.z - point.y) * towards.y; }
};

// Removes the part of the mesh that the plane cuts away; triangles that the plane crosses are divided. `tags`
// may be null, or holds one number per triangle, which its parts keep. O(triangles)
void cut_away(TriangleMesh&, const CutPlane&, std::vector<std::uint32_t>* tags = nullptr);

// The cross-section of the solid ground in the plane, as upright strips `step` metres wide. O(strips)
TriangleMesh section_face(const Representation&, const CutPlane&, float step);

// The triangles t for which keep(t) is true; all vertices stay.
template <class Keep>
TriangleMesh part_of(const TriangleMesh& mesh, const Keep& keep) {
  TriangleMesh part{mesh.positions, mesh.normals, {}};
  for (std::size_t t = 0; t < mesh.triangles(); ++t) {
    if (keep(t)) part.indices.insert(part.indices.end(), &mesh.indices[3 * t], &mesh.indices[3 * t] + 3);
  }
  return part;
}

}  // namespace terrabench::figures
