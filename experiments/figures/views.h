// Pictures in space as papers draw ground: wires over white, blocks of rock, and ground cut open along
// upright planes to show what lies inside.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "renderers/context.h"
#include "renderers/scene.h"
#include "representations/representation.h"
#include "terrain/image.h"
#include "terrain/mesh.h"
#include "terrain/view.h"

namespace terrabench::figures {

// An upright plane. The ground on the side to which `towards` points is cut away.
struct CutPlane {
  glm::vec2 point{0}, towards{0};  // in plan: x, z; `towards` is a unit vector
  float in_front(glm::vec3 p) const { return (p.x - point.x) * towards.x + (p.z - point.y) * towards.y; }
};

// Divides the triangles that the plane crosses. `tags` holds one number per triangle, which its parts keep.
// O(triangles)
void cut_away(TriangleMesh&, const CutPlane&, std::vector<std::uint32_t>* tags = nullptr);

// The solid ground in the plane, as upright strips `step` metres wide. O(strips)
TriangleMesh section_face(const Representation&, const CutPlane&, float step);

// The triangles t for which keep(t); all vertices stay.
template <class Keep>
TriangleMesh part_of(const TriangleMesh& mesh, const Keep& keep) {
  TriangleMesh part{mesh.positions, mesh.normals, {}};
  for (std::size_t t = 0; t < mesh.triangles(); ++t) {
    if (keep(t)) part.indices.insert(part.indices.end(), &mesh.indices[3 * t], &mesh.indices[3 * t] + 3);
  }
  return part;
}

struct Look {
  glm::vec3 from{0.55F, 0.75F, 1.0F};  // direction towards the eye
  int width = 800, height = 600;       // pixels
  std::vector<CutPlane> cuts{};        // only ground that none of them cuts away is shown
  View at(const Bounds& box) const { return overview(box, width, height, from); }
};

// Opaque white triangles that hide the wires behind them; `wires` as in SceneMesh.
SceneMesh wired(const TriangleMesh&, std::vector<std::uint8_t> wires, float wire_width,
                Rgb wire_colour = SceneMesh{}.wire_color);
// The mesh in the colour of cut rock, shaded by its true slopes. O(vertices)
SceneMesh rock(const TriangleMesh&);

// The edges of the mesh's quadrilaterals, without their diagonals, over white triangles.
Image wire_view(GlContext&, const TriangleMesh&, const Look&, float wire_width);

}  // namespace terrabench::figures
