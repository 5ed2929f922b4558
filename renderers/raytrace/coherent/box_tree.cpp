#include "renderers/raytrace/coherent/box_tree.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <numeric>

#include "terrain/error.h"

namespace terrabench {
namespace {

constexpr std::uint32_t kLeaf = 2;  // boxes at most

// Ize, "Robust BVH ray traversal" (2013): the exit is moved by two units in the last place.
constexpr float kWiden = 1 + 2 * 0x1p-22F;

struct Slabs {
  glm::vec3 origin, inverse;
  float near, far;

  explicit Slabs(const Ray& ray, float most)
      : origin(ray.origin), inverse(1.0F / ray.direction), near(ray.near), far(most) {}

  // Where the ray enters the box; false if it does not, or leaves it before `least`. The comparisons are such
  // that a NaN, from a ray that runs in a side of the box, does not exclude it.
  bool enters(const Bounds& box, float least, float& entry) const {
    float in = near, out = std::numeric_limits<float>::infinity();
    for (int k = 0; k < 3; ++k) {
      const float a = (box.low[k] - origin[k]) * inverse[k], b = (box.high[k] - origin[k]) * inverse[k];
      const float low = inverse[k] < 0 ? b : a, high = inverse[k] < 0 ? a : b;
      in = low > in ? low : in;
      out = high * kWiden < out ? high * kWiden : out;
    }
    entry = in;
    return in <= out && in <= far && least <= out;
  }
};

bool before(float entry, std::uint32_t box, const BoxVisit& other) {
  return entry < other.entry || (entry == other.entry && box < other.box);
}

}  // namespace

BoxTree::BoxTree(std::span<const Bounds> boxes) : boxes_(boxes.begin(), boxes.end()), order_(boxes.size()) {
  for (std::size_t b = 0; b < boxes.size(); ++b) {
    const glm::vec3 size = boxes[b].size();
    const bool good = size.x >= 0 && size.y >= 0 && size.z >= 0 && std::isfinite(size.x + size.y + size.z);
    if (!good) {
      throw bad_input("the box is not finite, or its low exceeds its high", fmt::format("box {}", b),
                      "correct its corners");
    }
  }
  std::iota(order_.begin(), order_.end(), 0U);
  nodes_.reserve(2 * boxes.size());
  if (!boxes.empty()) build(0, static_cast<std::uint32_t>(boxes.size()));
}

std::uint32_t BoxTree::build(std::uint32_t first, std::uint32_t last) {
  const auto number = static_cast<std::uint32_t>(nodes_.size());
  nodes_.push_back({boxes_[order_[first]], first, last - first});
  Bounds box = nodes_[number].box;
  for (std::uint32_t i = first; i < last; ++i) {
    box.low = glm::min(box.low, boxes_[order_[i]].low);
    box.high = glm::max(box.high, boxes_[order_[i]].high);
  }
  nodes_[number].box = box;
  if (last - first <= kLeaf) return number;
  const glm::vec3 size = box.size();
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  const auto middle_of = [&](std::uint32_t b) { return boxes_[b].low[axis] + boxes_[b].high[axis]; };
  const std::uint32_t middle = first + (last - first) / 2;
  std::nth_element(order_.begin() + first, order_.begin() + middle, order_.begin() + last,
                   [&](std::uint32_t a, std::uint32_t b) {
                     const float at_a = middle_of(a), at_b = middle_of(b);
                     return at_a != at_b ? at_a < at_b : a < b;
                   });
  build(first, middle);
  const std::uint32_t right = build(middle, last);
  nodes_[number].first = right;
  nodes_[number].count = 0;
  return number;
}

BoxVisit BoxTree::next(const Ray& ray, const BoxVisit& last, float far) const {
  BoxVisit found;
  if (nodes_.empty()) return found;
  Slabs slabs(ray, far);
  const bool first = last.box == BoxVisit::kNone;
  std::uint32_t stack[64];  // the tree halves its boxes at every node
  unsigned depth = 0;
  stack[depth++] = 0;
  while (depth > 0) {
    const std::uint32_t number = stack[--depth];
    const Node& node = nodes_[number];
    float entry = 0;
    if (!slabs.enters(node.box, last.entry, entry)) continue;
    if (node.count == 0) {
      stack[depth++] = node.first;
      stack[depth++] = number + 1;
      continue;
    }
    for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
      const std::uint32_t box = order_[i];
      if (!slabs.enters(boxes_[box], last.entry, entry)) continue;
      const bool after = first || entry > last.entry || (entry == last.entry && box > last.box);
      if (!after || (found.found() && !before(entry, box, found))) continue;
      found = {entry, box};
      slabs.far = entry;
    }
  }
  return found;
}

}  // namespace terrabench
