#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "renderers/scene_parts.h"

namespace terrabench {
namespace {

constexpr std::uint8_t kAllEdges = 7;

// The triangle's longest edge in plan, or, for vertical triangles, seen along the axis that they face most.
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
  std::uint8_t k;  // from the triangle's corner k to the next
};

Side side_of(const TriangleMesh& mesh, std::size_t triangle, int k) {
  const std::uint32_t* const v = mesh.indices.data() + 3 * triangle;
  const std::uint64_t a = v[k], b = v[(k + 1) % 3];
  return {std::min(a, b) << 32 | std::max(a, b), static_cast<std::uint32_t>(triangle),
          static_cast<std::uint8_t>(k)};
}

void sort(std::vector<Side>& sides) {
  std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
    return a.edge != b.edge ? a.edge < b.edge : a.triangle < b.triangle;
  });
}

// Whether the edge of the two sides is a silhouette: one triangle faces the eye, and the other does not and
// lies behind the first one's plane. (If it lies in front of the plane, the fold is concave and not an
// outline.)
bool is_outline(const TriangleMesh& mesh, const Side& first, const Side& second, const glm::vec3& eye) {
  const auto corner = [&](const Side& side, int k) -> const glm::vec3& {
    return mesh
        .positions[mesh.indices[3 * std::size_t{side.triangle} + static_cast<std::size_t>((side.k + k) % 3)]];
  };
  const auto normal = [&](const Side& side) {
    return glm::cross(corner(side, 1) - corner(side, 0), corner(side, 2) - corner(side, 0));
  };
  const auto faces = [&](const Side& side) { return glm::dot(normal(side), eye - corner(side, 0)) > 0; };
  if (faces(first) == faces(second)) return false;
  const Side& front = faces(first) ? first : second;
  const Side& back = faces(first) ? second : first;
  return glm::dot(normal(front), corner(back, 2) - corner(front, 0)) < 0;
}

}  // namespace

std::vector<std::uint8_t> quad_wires(const TriangleMesh& mesh) {
  std::vector<std::uint8_t> wires(mesh.triangles(), kAllEdges);
  std::vector<Side> longest(mesh.triangles());
  for (std::size_t t = 0; t < mesh.triangles(); ++t) {
    const std::uint32_t* const v = mesh.indices.data() + 3 * t;
    longest[t] =
        side_of(mesh, t, longest_edge({mesh.positions[v[0]], mesh.positions[v[1]], mesh.positions[v[2]]}));
  }
  sort(longest);
  for (std::size_t i = 1; i < longest.size(); ++i) {
    if (longest[i].edge != longest[i - 1].edge) continue;
    for (const Side& side : {longest[i - 1], longest[i]}) {
      wires[side.triangle] = static_cast<std::uint8_t>(wires[side.triangle] & ~(1U << side.k));
    }
  }
  return wires;
}

std::vector<std::uint8_t> with_outlines(const TriangleMesh& mesh, std::vector<std::uint8_t> wires,
                                        const glm::vec3& eye) {
  if (wires.empty()) wires.assign(mesh.triangles(), kAllEdges);
  std::vector<Side> sides;
  sides.reserve(3 * mesh.triangles());
  for (std::size_t t = 0; t < mesh.triangles(); ++t) {
    for (int k = 0; k < 3; ++k) sides.push_back(side_of(mesh, t, k));
  }
  sort(sides);
  const auto mark = [&](const Side& side, unsigned bits) {
    wires[side.triangle] = static_cast<std::uint8_t>(wires[side.triangle] | bits << side.k);
  };
  for (std::size_t i = 0, next = 0; i < sides.size(); i = next) {
    while (next < sides.size() && sides[next].edge == sides[i].edge) ++next;
    if (next - i == 1) {
      mark(sides[i], kOutlineBit);
    } else if (next - i == 2 && is_outline(mesh, sides[i], sides[i + 1], eye)) {
      mark(sides[i], kOutlineBit | 1U);
      mark(sides[i + 1], kOutlineBit | 1U);
    }
  }
  return wires;
}

}  // namespace terrabench
