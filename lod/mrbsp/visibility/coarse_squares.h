// The squares whose halves are the coarse triangles, those of one odd depth of the tree, and the halves'
// element numbers: element e of depth C is node 2^C + e. 8 bytes per square.
#pragma once

#include <glm/common.hpp>
#include <vector>

#include "lod/mrbsp/bisection_tree.h"

namespace terrabench::mrbsp::visibility {

class CoarseSquares {
 public:
  CoarseSquares(const BisectionTree& tree, int depth)
      : side_(tree.square_at(depth)), along_(tree.side() / side_) {
    elements_.resize(std::size_t{2} * along_ * along_);
    const auto roots = tree.roots();
    for (unsigned which = 0; which < 2; ++which) number(roots[which], 1, depth, 2 + which);
  }

  int side() const { return side_; }    // samples
  int along() const { return along_; }  // squares along the tree's side
  // Whether the diagonal runs from (low x, low z) to (high x, high z); else from (low x, high z) to
  // (high x, low z).
  static bool rising(glm::ivec2 square) { return (square.x + square.y) % 2 == 0; }
  // Half 0 has its right angle at low x: at high z if the diagonal rises, else at low z.
  std::uint32_t element(glm::ivec2 square, int half) const {
    return elements_[2 * (static_cast<std::size_t>(square.y) * along_ + square.x) + half];
  }

 private:
  void number(const PlanTriangle& t, int at, int depth, NodeNumber node) {
    if (at < depth) {
      for (unsigned which = 0; which < 2; ++which) {
        number(BisectionTree::child(t, which), at + 1, depth, 2 * node + which);
      }
      return;
    }
    const glm::ivec2 low = glm::min(glm::min(t.apex, t.left), t.right) / side_;
    const int half = t.apex.x == low.x * side_ ? 0 : 1;
    elements_[2 * (static_cast<std::size_t>(low.y) * along_ + low.x) + half] =
        static_cast<std::uint32_t>(node - first_node(depth));
  }

  int side_, along_;
  std::vector<std::uint32_t> elements_;
};

}  // namespace terrabench::mrbsp::visibility
