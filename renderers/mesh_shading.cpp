#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <glm/geometric.hpp>

#include "renderers/scene_parts.h"

namespace terrabench {

std::vector<float> curvature_shading(const TriangleMesh& mesh) {
  const std::size_t n = mesh.positions.size();
  std::vector<float> bend(n, 0.0F), sum(n, 0.0F);
  std::vector<std::uint32_t> count(n, 0);
  const auto for_each_edge = [&](auto&& visit) {
    for (std::size_t t = 0; t + 2 < mesh.indices.size(); t += 3) {
      for (std::size_t k = 0; k < 3; ++k) visit(mesh.indices[t + k], mesh.indices[t + (k + 1) % 3]);
    }
  };
  for_each_edge([&](std::uint32_t i, std::uint32_t j) {
    const glm::vec3 along = mesh.positions[j] - mesh.positions[i];
    const float length = glm::length(along);
    if (!(length > 0)) return;
    const float angle = glm::dot(mesh.normals[j] - mesh.normals[i], along) / length;
    for (const std::uint32_t v : {i, j}) {
      bend[v] += angle;
      ++count[v];
    }
  });
  for (std::size_t v = 0; v < n; ++v) bend[v] /= static_cast<float>(std::max(count[v], 1U));

  for (int pass = 0; pass < 2; ++pass) {
    std::fill(sum.begin(), sum.end(), 0.0F);
    std::fill(count.begin(), count.end(), 0U);
    for_each_edge([&](std::uint32_t i, std::uint32_t j) {
      sum[i] += bend[j];
      sum[j] += bend[i];
      ++count[i];
      ++count[j];
    });
    for (std::size_t v = 0; v < n; ++v) {
      bend[v] = 0.5F * (bend[v] + sum[v] / static_cast<float>(std::max(count[v], 1U)));
    }
  }

  // Relative to the mesh's typical bend, so that fine and coarse meshes of one ground look alike; a bend
  // below kStraight radians counts as none.
  constexpr float kStrength = 0.17F, kStraight = 0.01F;
  double squares = 0;
  for (const float b : bend) squares += static_cast<double>(b) * b;
  const float typical = std::max(static_cast<float>(std::sqrt(squares / static_cast<double>(n))), kStraight);
  for (float& b : bend) b = kStrength * std::tanh(b / (1.5F * typical));
  return bend;
}

float choose_exaggeration(const TriangleMesh& mesh) {
  constexpr float kMeanSlope = 0.45F, kMost = 8.0F;
  double rise = 0, area = 0;
  for (std::size_t t = 0; t + 2 < mesh.indices.size(); t += 3) {
    const glm::vec3& a = mesh.positions[mesh.indices[t]];
    const glm::vec3 normal =
        glm::cross(mesh.positions[mesh.indices[t + 1]] - a, mesh.positions[mesh.indices[t + 2]] - a);
    const float horizontal = std::hypot(normal.x, normal.z);
    if (normal.y <= 0.2F * horizontal) continue;
    rise += horizontal;
    area += normal.y;
  }
  const auto slope = static_cast<float>(rise / area);  // not a number when nothing faces up
  return slope > 0 ? std::clamp(kMeanSlope / slope, 1.0F, kMost) : 1.0F;
}

}  // namespace terrabench
