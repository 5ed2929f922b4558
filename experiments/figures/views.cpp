#include "experiments/figures/views.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <utility>

#include "experiments/figures/ground.h"

namespace terrabench::figures {

void cut_away(TriangleMesh& mesh, const CutPlane& plane, std::vector<std::uint32_t>* tags) {
  const auto add = [&](std::uint32_t from, std::uint32_t to) {
    const glm::vec3 a = mesh.positions[from], b = mesh.positions[to];
    const float share = plane.in_front(a) / (plane.in_front(a) - plane.in_front(b));
    mesh.positions.push_back(glm::mix(a, b, share));
    if (!mesh.normals.empty()) {
      mesh.normals.push_back(glm::normalize(glm::mix(mesh.normals[from], mesh.normals[to], share)));
    }
    return static_cast<std::uint32_t>(mesh.positions.size() - 1);
  };
  std::vector<std::uint32_t> kept, kept_tags, polygon;
  for (std::size_t t = 0; t < mesh.triangles(); ++t) {
    polygon.clear();
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = mesh.indices[3 * t + k], b = mesh.indices[3 * t + (k + 1) % 3];
      const bool a_goes = plane.in_front(mesh.positions[a]) > 0,
                 b_goes = plane.in_front(mesh.positions[b]) > 0;
      if (!a_goes) polygon.push_back(a);
      if (a_goes != b_goes) polygon.push_back(add(a, b));
    }
    for (std::size_t k = 2; k < polygon.size(); ++k) {
      kept.insert(kept.end(), {polygon[0], polygon[k - 1], polygon[k]});
      if (tags != nullptr) kept_tags.push_back((*tags)[t]);
    }
  }
  mesh.indices = std::move(kept);
  if (tags != nullptr) *tags = std::move(kept_tags);
}

TriangleMesh section_face(const Representation& ground, const CutPlane& plane, float step) {
  const Bounds box = ground.bounds();
  const glm::vec2 along(plane.towards.y, -plane.towards.x);  // to the right, seen from in front of the face
  const float reach = glm::length(glm::vec2(box.size().x, box.size().z));
  std::vector<float> x, z;
  for (float at = -reach; at <= reach; at += step) {
    const glm::vec2 p = plane.point + at * along;
    if (p.x < box.low.x || p.y < box.low.z || p.x > box.high.x || p.y > box.high.z) continue;
    x.push_back(p.x);
    z.push_back(p.y);
  }
  SpanSink sink;
  ground.spans({x, z}, sink);
  TriangleMesh mesh;
  const glm::vec2 half = 0.51F * step * along;  // strips overlap a little
  for (std::size_t c = 0; c < x.size(); ++c) {
    const glm::vec2 left = glm::vec2(x[c], z[c]) - half, right = glm::vec2(x[c], z[c]) + half;
    for (const Span& span : sink.column(c)) {
      add_quad(mesh, {glm::vec3(left.x, span.bottom, left.y), glm::vec3(right.x, span.bottom, right.y),
                      glm::vec3(right.x, span.top, right.y), glm::vec3(left.x, span.top, left.y)});
    }
  }
  return mesh;
}

SceneMesh wired(const TriangleMesh& mesh, std::vector<std::uint8_t> wires, float wire_width,
                Rgb wire_colour) {
  SceneMesh item;
  item.mesh = &mesh;
  item.shading = Shading::kFlat;
  item.wire_width = wire_width;
  item.wire_color = wire_colour;
  item.wires = std::move(wires);
  return item;
}

SceneMesh rock(const TriangleMesh& mesh) {
  SceneMesh item;
  item.mesh = &mesh;
  item.colors.assign(mesh.positions.size(), {196, 178, 158});
  item.shading_exaggeration = 1;
  return item;
}

Image wire_view(GlContext& gl, const TriangleMesh& mesh, const Look& look, float wire_width) {
  Scene scene;
  scene.meshes.push_back(wired(mesh, quad_wires(mesh), wire_width));
  return render_scene(gl, scene, look.at(bounds_of(mesh)));
}

}  // namespace terrabench::figures
