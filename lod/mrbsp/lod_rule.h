// The depth at which a triangle is drawn (MRBSP paper, §3): it is split while the thresholds of all its
// corners, at their distances D, exceed its depth.
//
// Printed threshold: M - log2(D/S), where S is the short side of the smallest triangles. A split halves the
// area, not the side, so with this formula the apparent side falls with 1/√D; M - 2·log2(D/S) keeps it
// constant. The paper's figure 1 shows integer thresholds. Here they are rounded up, so no triangle is larger
// than the formula says. O(1).
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <string_view>
#include <vector>

#include "lod/mrbsp/bisection_tree.h"
#include "terrain/memory.h"

namespace terrabench {

class LodRule {
 public:
  // `short_side`: S in metres, scaled by the knob. `area_consistent`: M - 2·log2(D/S).
  LodRule(int deepest, double short_side, bool area_consistent)
      : deepest_(deepest),
        area_consistent_(area_consistent),
        per_square_(static_cast<float>(1 / (short_side * short_side))) {}

  // Not clamped: greater than M near the eye, possibly negative far away.
  int threshold(const glm::vec3& eye, const glm::vec3& vertex) const {
    const glm::vec3 to = vertex - eye;
    const int steps = floor_log2(glm::dot(to, to) * per_square_);
    return deepest_ - (area_consistent_ ? steps : steps >> 1);
  }

 private:
  // ⌊log2(x)⌋ for normal x and infinity (128); -127 for 0 and subnormal x.
  static int floor_log2(float x) { return static_cast<int>(std::bit_cast<std::uint32_t>(x) >> 23) - 127; }

  int deepest_;
  bool area_consistent_;
  float per_square_;  // 1/S²
};

// How holes are avoided where triangles of different depth meet (MRBSP paper, §3).
//
// Printed: a triangle is drawn as its two halves if its right angle alone has a lower threshold than the
// other two corners. The rule looks at one triangle only, so it leaves holes where neighbours differ in
// another way.
// Conforming: a vertex splits triangles only together with its parents (BisectionTree::parents()), so these
// split too, whatever their thresholds. This adds the fewest splits that leave no hole.
enum class HoleRule : std::uint8_t { kConforming, kPrinted, kNone };  // kNone: for measurements
inline constexpr std::string_view kHoleRuleNames[] = {"conforming", "printed", "left"};

// The printed rule: whether a hole may open at the centre of the hypotenuse, given the corners' thresholds.
inline bool may_open(int apex, int left, int right, int deepest) {
  return std::min(apex, deepest) < std::min({left, right, deepest});
}

// The conforming rule: the vertices at which triangles are split. One bit per vertex, and 8 B per split.
// While triangles are split, nothing is looked up: add() only notes, for close(), the one parent that may be
// missing.
class SplitVertices {
 public:
  explicit SplitVertices(const BisectionTree& tree)
      : tree_(tree), along_(static_cast<std::uint32_t>(tree.side()) + 1) {
    bits_.resize((static_cast<std::size_t>(along_) * along_ + 63) / 64);
  }

  bool has(glm::ivec2 vertex) const {
    const std::uint32_t bit = bit_of(vertex);
    return ((bits_[bit / 64] >> (bit % 64)) & 1) != 0;
  }
  // Splits the triangle, all of whose ancestors are split.
  void add(const PlanTriangle& split) {
    const std::uint32_t centre = bit_of((split.left + split.right) / 2);
    set(centre);
    // The right angle across the hypotenuse. At the border there is none.
    const glm::ivec2 across = split.left + split.right - split.apex;
    const auto inside = [&](int at) { return static_cast<std::uint32_t>(at) < along_; };
    added_.push_back({centre, inside(across.x) && inside(across.y) ? bit_of(across) : centre});
  }
  // Adds all ancestors. The recursion is at most as deep as the tree: parents lie one level above.
  void close() {
    for (std::size_t k = 0, end = added_.size(); k < end; ++k) add_with_ancestors(added_[k].across);
  }
  // O(vertices added).
  void clear() {
    for (const Added& vertex : added_) bits_[vertex.bit / 64] = 0;
    added_.clear();
  }
  Memory memory() const { return index_memory(bits_, added_); }

 private:
  struct Added {
    std::uint32_t bit, across;
  };

  std::uint32_t bit_of(glm::ivec2 at) const {
    return static_cast<std::uint32_t>(at.y) * along_ + static_cast<std::uint32_t>(at.x);
  }
  void set(std::uint32_t bit) { bits_[bit / 64] |= std::uint64_t{1} << (bit % 64); }
  void add_with_ancestors(std::uint32_t bit) {
    if (((bits_[bit / 64] >> (bit % 64)) & 1) != 0) return;
    set(bit);
    added_.push_back({bit, bit});
    const BisectionTree::Parents parents =
        tree_.parents({static_cast<int>(bit % along_), static_cast<int>(bit / along_)});
    for (int k = 0; k < parents.count; ++k) add_with_ancestors(bit_of(parents.at[k]));
  }

  BisectionTree tree_;
  std::uint32_t along_;  // vertices along a side
  std::vector<std::uint64_t> bits_;
  std::vector<Added> added_;
};

}  // namespace terrabench
