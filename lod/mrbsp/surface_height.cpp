#include "lod/mrbsp/surface_height.h"

#include <algorithm>
#include <glm/common.hpp>

namespace terrabench {

float sample_height(const GroundGrid& grid, float x, float z) {
  const int i = std::min(static_cast<int>(x), grid.width - 2),
            j = std::min(static_cast<int>(z), grid.depth - 2);
  const float* const at = grid.heights.data() + static_cast<std::size_t>(j) * grid.width + i;
  const float s = x - static_cast<float>(i), t = z - static_cast<float>(j);
  return glm::mix(glm::mix(at[0], at[1], s), glm::mix(at[grid.width], at[grid.width + 1], s), t);
}

float surface_height(const BisectionTree& tree, const GroundGrid& grid, float x, float z) {
  const glm::ivec2 last(grid.width - 1, grid.depth - 1);
  const glm::vec2 at = glm::clamp(glm::vec2(x / grid.cell_x, z / grid.cell_z), glm::vec2(0), glm::vec2(last));
  const auto cross = [](glm::vec2 a, glm::vec2 b) { return a.x * b.y - a.y * b.x; };
  const auto height = [&](glm::ivec2 vertex) {
    vertex = glm::min(vertex, last);
    return grid.heights[static_cast<std::size_t>(vertex.y) * grid.width + vertex.x];
  };
  PlanTriangle t = tree.roots()[at.x >= at.y ? 0 : 1];
  for (int depth = 1; depth < tree.depth(); ++depth) {
    const glm::vec2 apex(t.apex), down = glm::vec2((t.left + t.right) / 2) - apex;
    const bool left = cross(down, at - apex) * cross(down, glm::vec2(t.left) - apex) >= 0;
    t = BisectionTree::child(t, left ? 0 : 1);
  }
  const float a = height(t.apex), b = height(t.left), c = height(t.right);
  const glm::ivec2 furthest = glm::max(glm::max(t.apex, t.left), t.right);
  if (furthest.x > last.x || furthest.y > last.y) return std::max({a, b, c});
  const glm::vec2 u = t.left - t.apex, v = t.right - t.apex, w = at - glm::vec2(t.apex);
  const float area = cross(u, v);
  return a + (b - a) * (cross(w, v) / area) + (c - a) * (cross(u, w) / area);
}

}  // namespace terrabench
