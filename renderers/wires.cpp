// Which edges of a mesh of four-sided cells are the cells' own.
#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "renderers/scene.h"

namespace terrabench {
namespace {

// The edge of a triangle that is its longest, seen along the vertical or, of upright triangles, along the
// axis that they face most.
int longest_edge(const std::array<glm::vec3, 3>& corner) {
  constexpr float kUpright = 1e-3F;
  const glm::vec3 normal = glm::cross(corner[1] - corner[0], corner[2] - corner[0]);
  const int axis = std::abs(normal.y) > kUpright * glm::length(normal) ? 1
                   : std::abs(normal.x) > std::abs(normal.z)           ? 0
                                                                       : 2;
  int longest = 0;
  float most = -1;
  for (int k = 0; k < 3; ++k) {
    glm::vec3 along = corner[static_cast<std::size_t>((k + 1) % 3)] - corner[static_cast<std::size_t>(k)];
    along[axis] = 0;
    const float length = glm::dot(along, along);
    if (length > most) {
      most = length;
      longest = k;
    }
  }
  return longest;
}

struct Side {
  std::uint64_t edge;  // both vertices, the smaller first
  std::uint32_t triangle;
  std::uint8_t bit;
};

}  // namespace

std::vector<std::uint8_t> quad_wires(const TriangleMesh& mesh) {
  constexpr std::uint8_t kAll = 7;
  std::vector<std::uint8_t> wires(mesh.triangles(), kAll);
  std::vector<Side> longest(mesh.triangles());
  for (std::size_t t = 0; t < mesh.triangles(); ++t) {
    const std::uint32_t* const v = mesh.indices.data() + 3 * t;
    const int k = longest_edge({mesh.positions[v[0]], mesh.positions[v[1]], mesh.positions[v[2]]});
    const std::uint64_t a = v[k], b = v[(k + 1) % 3];
    longest[t] = {std::min(a, b) << 32 | std::max(a, b), static_cast<std::uint32_t>(t),
                  static_cast<std::uint8_t>(1U << k)};
  }
  std::sort(longest.begin(), longest.end(), [](const Side& a, const Side& b) {
    return a.edge != b.edge ? a.edge < b.edge : a.triangle < b.triangle;
  });
  for (std::size_t i = 1; i < longest.size(); ++i) {
    if (longest[i].edge != longest[i - 1].edge) continue;
    for (const Side& side : {longest[i - 1], longest[i]}) {
      wires[side.triangle] = static_cast<std::uint8_t>(wires[side.triangle] & ~side.bit);
    }
  }
  return wires;
}

}  // namespace terrabench
