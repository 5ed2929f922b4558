#include "terrain/mesh.h"

#include <algorithm>
#include <array>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace terrabench {

Bounds box_of(std::span<const glm::vec3> positions) {
  if (positions.empty()) return {};
  Bounds box{positions[0], positions[0]};
  for (const glm::vec3& p : positions) {
    box.low = glm::min(box.low, p);
    box.high = glm::max(box.high, p);
  }
  return box;
}

Bounds bounds_of(const TriangleMesh& mesh) { return box_of(mesh.positions); }

void compute_normals(TriangleMesh& mesh) {
  mesh.normals.assign(mesh.positions.size(), glm::vec3(0));
  for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
    const std::uint32_t a = mesh.indices[i], b = mesh.indices[i + 1], c = mesh.indices[i + 2];
    // The cross product's length is twice the area, which is the weight.
    const glm::vec3 normal =
        glm::cross(mesh.positions[b] - mesh.positions[a], mesh.positions[c] - mesh.positions[a]);
    for (const std::uint32_t v : {a, b, c}) mesh.normals[v] += normal;
  }
  for (glm::vec3& normal : mesh.normals) {
    const float length = glm::length(normal);
    normal = length > 0 ? normal / length : glm::vec3(0, 1, 0);
  }
}

EdgeReport check_edges(const TriangleMesh& mesh) {
  // One key per side of an edge: the vertices in ascending order, and a bit for the direction in which the
  // triangle traverses it.
  struct Side {
    std::uint64_t edge;
    bool forward;
  };
  std::vector<Side> sides;
  sides.reserve(mesh.indices.size());
  for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
    for (int k = 0; k < 3; ++k) {
      const std::uint64_t a = mesh.indices[i + k], b = mesh.indices[i + (k + 1) % 3];
      sides.push_back({std::min(a, b) << 32U | std::max(a, b), a < b});
    }
  }
  std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) { return a.edge < b.edge; });
  EdgeReport report;
  for (std::size_t i = 0, end = 0; i < sides.size(); i = end) {
    std::size_t forward = 0;
    for (end = i; end < sides.size() && sides[end].edge == sides[i].edge; ++end)
      forward += sides[end].forward;
    ++report.edges;
    report.open += end - i == 1;
    report.non_manifold += end - i > 2;
    report.misoriented += end - i == 2 && forward != 1;
  }
  return report;
}

}  // namespace terrabench
