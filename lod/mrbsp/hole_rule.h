// How level of detail keeps holes out of the ground where levels meet (MRBSP paper, §3).
//
// Printed: a triangle whose right angle alone has a lower threshold than its other two corners is drawn as
// its two halves. That looks at one triangle and leaves holes where neighbours differ otherwise. Conforming:
// a cut needs the cuts of the two triangles that made its own (BisectionTree::parents), so these are made
// too, as few as are needed, whatever the thresholds say.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "lod/mrbsp/bisection_tree.h"
#include "terrain/memory.h"

namespace terrabench {

// The printed rule: may a hole open in the middle of the hypotenuse? By the corners' thresholds.
inline bool may_open(int apex, int left, int right, int deepest) {
  return std::min(apex, deepest) < std::min({left, right, deepest});
}

// The conforming rule: where triangles are cut, by the middle of their hypotenuse. A bit a lattice vertex.
class Cuts {
 public:
  explicit Cuts(const BisectionTree& tree);

  bool has(glm::ivec2 foot) const {
    const std::size_t bit = bit_of(foot);
    return ((bits_[bit / 64] >> (bit % 64)) & 1) != 0;
  }
  // With all that it needs. As deep as the tree at most: a cut's parents lie one level above it.
  void add(glm::ivec2 foot) {
    const std::size_t bit = bit_of(foot);
    std::uint64_t& word = bits_[bit / 64];
    const std::uint64_t mask = std::uint64_t{1} << (bit % 64);
    if ((word & mask) != 0) return;
    if (word == 0) marked_.push_back(static_cast<std::uint32_t>(bit / 64));
    word |= mask;
    const BisectionTree::Parents parents = tree_.parents(foot);
    for (int k = 0; k < parents.count; ++k) add(parents.at[k]);
  }
  // O(cuts).
  void clear();
  Memory memory() const;

 private:
  std::size_t bit_of(glm::ivec2 at) const {
    return static_cast<std::size_t>(at.y) * (static_cast<std::size_t>(tree_.side()) + 1) +
           static_cast<std::size_t>(at.x);
  }

  BisectionTree tree_;
  std::vector<std::uint64_t> bits_;
  std::vector<std::uint32_t> marked_;  // words of bits_ that are not zero
};

}  // namespace terrabench
