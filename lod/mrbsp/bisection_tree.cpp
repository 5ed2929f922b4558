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

}  // namespace terrabench
