#include "experiments/meshgrow/growing_pictures.h"

#include <cmath>
#include <deque>
#include <glm/geometric.hpp>

#include "experiments/figures/projection.h"
#include "experiments/meshgrow/fork.h"
#include "renderers/scene.h"

namespace terrabench::meshgrow {

using namespace figures;

glm::vec3 middle_of(const FaceMesh& mesh, std::uint32_t face) {
  glm::vec3 sum(0);
  for (const std::uint32_t corner : mesh.face(face)) sum += mesh.positions[corner];
  return sum / static_cast<float>(mesh.face(face).size());
}

Fans fans_of(const FaceMesh& mesh) {
  Fans fans;
  fans.mesh.positions = mesh.positions;
  for (std::uint32_t f = 0; f < mesh.faces(); ++f) {
    const auto corners = mesh.face(f);
    for (std::size_t k = 1; k + 1 < corners.size(); ++k) {
      fans.mesh.indices.insert(fans.mesh.indices.end(), {corners[0], corners[k], corners[k + 1]});
      fans.wires.push_back(
          static_cast<std::uint8_t>(2U | (k == 1 ? 1U : 0U) | (k + 2 == corners.size() ? 4U : 0U)));
      fans.faces.push_back(f);
    }
  }
  return fans;
}

Image face_picture(GlContext& gl, const FaceMesh& mesh, const View& view,
                   const std::function<Rgb(std::uint32_t face)>& colour) {
  const Fans fans = fans_of(mesh);
  const glm::vec3 back = glm::normalize(view.eye - view.target);
  const glm::vec3 right = glm::normalize(glm::cross(view.up, back));
  const glm::vec3 light = glm::normalize(0.8F * back - 0.55F * right + glm::vec3(0, 0.9F, 0));
  std::deque<TriangleMesh> parts;
  Scene scene;
  for (std::size_t t = 0; t < fans.faces.size();) {
    const std::uint32_t face = fans.faces[t];
    TriangleMesh& part = parts.emplace_back();
    part.positions = mesh.positions;
    SceneMesh item;
    glm::vec3 normal(0);
    for (; t < fans.faces.size() && fans.faces[t] == face; ++t) {
      const std::uint32_t* const at = &fans.mesh.indices[3 * t];
      part.indices.insert(part.indices.end(), at, at + 3);
      item.wires.push_back(fans.wires[t]);
      normal += glm::cross(mesh.positions[at[1]] - mesh.positions[at[0]],
                           mesh.positions[at[2]] - mesh.positions[at[0]]);
    }
    const float shade = 0.72F + 0.28F * std::max(0.0F, glm::dot(glm::normalize(normal), light));
    const auto shaded = [&](std::uint8_t value) {
      return static_cast<std::uint8_t>(std::lround(shade * static_cast<float>(value)));
    };
    const Rgb fill = colour(face);
    item.mesh = &part;
    item.shading = Shading::kFlat;
    item.fill = {shaded(fill[0]), shaded(fill[1]), shaded(fill[2])};
    item.wire_width = 2.4F;
    scene.meshes.push_back(std::move(item));
  }
  return render_scene(gl, scene, view);
}

OverPicture::OverPicture(const FaceMesh& mesh, const View& view, SheetPoint corner)
    : mesh_(fans_of(mesh).mesh), view_(view), corner_(corner) {}

SheetPoint OverPicture::at(const glm::vec3& p) const {
  const SheetPoint at = figures::project(view_, p).at;
  return {corner_.x + at.x, corner_.y + at.y};
}

bool OverPicture::visible(const glm::vec3& p) const {
  const glm::dvec3 eye(view_.eye), ray = glm::dvec3(p) - eye;
  for (std::size_t t = 0; t < mesh_.triangles(); ++t) {
    const auto corner = [&](std::size_t k) { return glm::dvec3(mesh_.positions[mesh_.indices[3 * t + k]]); };
    const glm::dvec3 a = corner(0), ab = corner(1) - a, ac = corner(2) - a;
    const glm::dvec3 across = glm::cross(ray, ac);
    const double scale = glm::dot(ab, across);
    if (std::abs(scale) < 1e-12) continue;
    const double u = glm::dot(eye - a, across) / scale;
    const glm::dvec3 turned = glm::cross(eye - a, ab);
    const double v = glm::dot(ray, turned) / scale, share = glm::dot(ac, turned) / scale;
    if (u >= 0 && v >= 0 && u + v <= 1 && share > 0 && share < 1 - 1e-4) return false;
  }
  return true;
}

void add_arrow(Sheet& sheet, SheetPoint from, SheetPoint to, Rgb colour, double thickness, double head) {
  const double length = std::max(std::hypot(to.x - from.x, to.y - from.y), 1e-6);
  const double x = (to.x - from.x) / length * head, y = (to.y - from.y) / length * head;
  sheet.stroke(from, to, colour, thickness);
  const SheetPoint tip[] = {
      {to.x - x - 0.45 * y, to.y - y + 0.45 * x}, to, {to.x - x + 0.45 * y, to.y - y - 0.45 * x}};
  sheet.line(tip, {.colour = colour, .thickness = thickness});
}

void add_label(Sheet& sheet, SheetPoint at, std::string_view words, int size, Rgb colour, double half_width) {
  sheet.box(at.x - half_width, at.y - 0.6 * size, 2 * half_width, 1.2 * size, {255, 255, 255});
  sheet.text(at.x, at.y + 0.36 * size, words, size, "middle", colour);
}

}  // namespace terrabench::meshgrow
