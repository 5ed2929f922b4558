#include "lod/mrbsp/bisection_tree.h"

#include <fmt/format.h>

#include <cassert>
#include <glm/common.hpp>

#include "terrain/error.h"

namespace terrabench {

BisectionTree::BisectionTree(int side_bits, int depth) : side_bits_(side_bits), depth_(depth) {
  if (side_bits < 0 || 2 * side_bits + 1 > kDeepest) {
    throw usage_error(fmt::format("the side of the tree's square must be from 2^0 to 2^{}, got 2^{}",
                                  (kDeepest - 1) / 2, side_bits),
                      "", "use terrain with fewer samples");
  }
  if (depth < 1 || depth > 2 * side_bits + 1) {
    throw usage_error(fmt::format("depth must be from 1 to {} for a square of side 2^{}, got {}",
                                  2 * side_bits + 1, side_bits, depth),
                      "", "choose a smaller depth, or 0 for the greatest");
  }
}

BisectionTree BisectionTree::over(int width, int samples_deep, int depth) {
  const int cells = std::max({width, samples_deep, 2}) - 1;
  const int side_bits = std::bit_width(static_cast<unsigned>(cells - 1));
  return {side_bits, depth == 0 ? 2 * side_bits + 1 : depth};
}

std::uint64_t BisectionTree::vertices() const {
  const std::uint64_t along = (std::uint64_t{1} << (depth_ / 2)) + 1;
  return depth_ % 2 == 1 ? along * along : (along * along + 1) / 2;
}

std::array<PlanTriangle, 2> BisectionTree::roots() const {
  const int n = side();
  return {{{{n, 0}, {0, 0}, {n, n}}, {{0, n}, {n, n}, {0, 0}}}};
}

PlanTriangle BisectionTree::triangle(NodeNumber node) const {
  assert(node >= 2);
  const int depth = depth_of(node);
  PlanTriangle t = roots()[(node >> (depth - 1)) & 1];
  for (int bit = depth - 2; bit >= 0; --bit) t = child(t, (node >> bit) & 1);
  return t;
}

std::string label(NodeNumber node) {
  std::string text;
  for (int bit = depth_of(node) - 1; bit >= 0; --bit) text += ((node >> bit) & 1) != 0 ? '1' : '0';
  return text;
}

bool parse_label(std::string_view text, NodeNumber& node) {
  if (text.empty() || text.size() > BisectionTree::kDeepest) return false;
  node = 1;
  for (const char digit : text) {
    if (digit != '0' && digit != '1') return false;
    node = 2 * node + static_cast<NodeNumber>(digit - '0');
  }
  return true;
}

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
