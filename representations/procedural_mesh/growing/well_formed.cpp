#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "representations/procedural_mesh/growing/frame.h"
#include "representations/procedural_mesh/growing/rules.h"
#include "representations/procedural_mesh/subdivision/topology.h"
#include "terrain/error.h"

namespace terrabench::growing {
namespace {

using subdivision::kNone;
using subdivision::Topology;

Topology topology_of(const FaceMesh& mesh, const std::string& where) {
  try {
    return subdivision::make_topology(mesh);
  } catch (const Error& error) {
    throw bad_input(error.what(), where, error.advice());
  }
}

void check_vertices(const Topology& t, const std::string& where) {
  for (std::uint32_t v = 0; v < t.vertices; ++v) {
    if (t.uses_of(v).empty())
      throw bad_input(fmt::format("vertex {} belongs to no face", v), where, "remove it");
  }
  if (t.sharp_points.empty()) return;  // where faces form one fan, nothing is sharp yet
  throw bad_input(fmt::format("vertex {} joins two fans of faces", t.sharp_points[0].vertex), where,
                  "give each fan a vertex of its own");
}

}  // namespace

Topology check_base(const FaceMesh& mesh, const std::string& where) {
  Topology t = topology_of(mesh, where);
  for (std::size_t f = 0; f < mesh.faces(); ++f) {
    const FaceShape shape = face_shape(mesh.face(f), mesh.positions);
    if (shape.area > 1e-9 * shape.size * shape.size) continue;
    throw bad_input(fmt::format("face {} has no area", f), where, "move its corners");
  }
  check_vertices(t, where);
  return t;
}

Topology check_template(const Template& replacement, const std::string& where) {
  const std::uint32_t n = replacement.corners;
  FaceMesh mesh = replacement.mesh;  // closed by the base, which runs through its edges the other way
  mesh.positions.resize(n + replacement.vertices.size());
  std::vector<std::uint32_t> base(n);
  std::iota(base.rbegin(), base.rend(), 0U);
  mesh.add_face(base);
  Topology t = topology_of(mesh, where);
  for (std::uint32_t a = 0; a < n; ++a) {
    const std::uint32_t b = (a + 1) % n;
    if (t.edges[subdivision::edge_between(t, a, b)].half[1] != kNone) continue;
    throw bad_input(
        fmt::format("the template does not fit its face: no face runs through the edge from {} to {} "
                    "of the base",
                    a, b),
        where, "give each edge of the base a face");
  }
  for (std::size_t f = 0; f < mesh.faces(); ++f) {
    const auto face = mesh.face(f);
    for (std::size_t k = 0; k < face.size(); ++k) {
      const std::uint32_t a = face[k], b = face[(k + 1) % face.size()];
      if (std::max(a, b) < n && b != (a + 1) % n && a != (b + 1) % n) {
        throw bad_input(fmt::format("an edge from {} to {} joins two corners of the base", a, b), where,
                        "put a vertex between them");
      }
      if (t.edges[subdivision::edge_between(t, a, b)].half[1] != kNone) continue;
      throw bad_input(fmt::format("the edge from {} to {} has one face only", a, b), where,
                      "close the template");
    }
  }
  check_vertices(t, where);
  return t;
}

}  // namespace terrabench::growing
