#include "representations/export/surface_mesh.h"

#include <algorithm>
#include <limits>

namespace terrabench {
namespace {

// By Newell's sum, for corners in any number that may lie in a line.
bool looks_down(const FaceMesh& mesh, std::span<const std::uint32_t> face) {
  float y = 0;
  for (std::size_t c = 0; c < face.size(); ++c) {
    const glm::vec3 a = mesh.positions[face[c]], b = mesh.positions[face[(c + 1) % face.size()]];
    y += (a.z - b.z) * (a.x + b.x);
  }
  return y < 0;
}

}  // namespace

FaceMesh surface_only(const FaceMesh& whole, const Bounds& bounds) {
  constexpr float kShare = 1e-5F;  // of the bounds' size: rounding of corners that lie in a plane
  constexpr std::uint32_t kUnused = std::numeric_limits<std::uint32_t>::max();
  const glm::vec3 low = bounds.low + kShare * bounds.size(), high = bounds.high - kShare * bounds.size();
  const auto closes = [&](std::span<const std::uint32_t> face) {
    const auto all = [&](auto lies) {
      return std::ranges::all_of(face, [&](std::uint32_t v) { return lies(whole.positions[v]); });
    };
    return (looks_down(whole, face) && all([&](glm::vec3 p) { return p.y <= low.y; })) ||
           all([&](glm::vec3 p) { return p.x <= low.x; }) ||
           all([&](glm::vec3 p) { return p.x >= high.x; }) ||
           all([&](glm::vec3 p) { return p.z <= low.z; }) || all([&](glm::vec3 p) { return p.z >= high.z; });
  };
  FaceMesh surface;
  std::vector<std::uint32_t> number(whole.positions.size(), kUnused), corners;
  for (std::size_t f = 0; f < whole.faces(); ++f) {
    if (closes(whole.face(f))) continue;
    corners.clear();
    for (const std::uint32_t v : whole.face(f)) {
      if (number[v] == kUnused) {
        number[v] = static_cast<std::uint32_t>(surface.positions.size());
        surface.positions.push_back(whole.positions[v]);
        if (!whole.texture.empty()) surface.texture.push_back(whole.texture[v]);
      }
      corners.push_back(number[v]);
    }
    surface.add_face(corners);
  }
  return surface;
}

void turn_z_up(FaceMesh& mesh) {
  for (glm::vec3& p : mesh.positions) p = {p.x, -p.z, p.y};
}

}  // namespace terrabench
