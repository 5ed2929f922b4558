#include "lod/mrbsp/triangle_bounds.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <glm/common.hpp>
#include <limits>

namespace terrabench {
namespace {

using Range = TriangleBounds::Range;

// Bounds end this many levels above the finest triangles, at most at depth 20 (2^21 ranges, 16 MiB).
constexpr int kLevelsUnderBounds = 4, kDeepestBounds = 20;

Range join(const Range& a, const Range& b) {
  return {std::min(a.lowest, b.lowest), std::max(a.highest, b.highest)};
}

class RangeFinder {
 public:
  RangeFinder(const GroundGrid& grid, const BisectionTree& tree, int depth, std::vector<Range>& ranges)
      : grid_(grid), tree_(tree), depth_(depth), ranges_(ranges) {}

  // Finds only ranges of triangles that touch these samples; the others must be known.
  void limit(glm::ivec2 low, glm::ivec2 high) {
    low_ = low;
    high_ = high;
  }

  // Sets the ranges of the triangle and of its subtree.
  void find(const PlanTriangle& t, int depth, NodeNumber node) const {
    if (!touches(t)) return;
    if (depth == depth_) {
      constexpr float kInfinity = std::numeric_limits<float>::infinity();
      Range range{kInfinity, -kInfinity};
      for (const glm::ivec2 at : {t.apex, t.left, t.right}) include(at, range);
      include_centres(t, depth, range);
      ranges_[node] = range;
      return;
    }
    for (unsigned which = 0; which < 2; ++which) {
      find(BisectionTree::child(t, which), depth + 1, 2 * node + which);
    }
    ranges_[node] = join(ranges_[2 * node], ranges_[2 * node + 1]);
  }

 private:
  // Vertices beyond the ground have the heights of its border.
  bool touches(const PlanTriangle& t) const {
    const glm::ivec2 last(grid_.width - 1, grid_.depth - 1);
    const glm::ivec2 from = glm::min(glm::min(t.apex, glm::min(t.left, t.right)), last),
                     to = glm::max(t.apex, glm::max(t.left, t.right));
    return from.x <= high_.x && from.y <= high_.y && to.x >= low_.x && to.y >= low_.y;
  }
  void include(glm::ivec2 at, Range& range) const {
    const float h = grid_.heights[static_cast<std::size_t>(std::min(at.y, grid_.depth - 1)) * grid_.width +
                                  std::min(at.x, grid_.width - 1)];
    range.lowest = std::min(range.lowest, h);
    range.highest = std::max(range.highest, h);
  }
  // The corners in a triangle's subtree are its own and the centres of all hypotenuses in the subtree.
  void include_centres(const PlanTriangle& t, int depth, Range& range) const {
    if (depth == tree_.depth()) return;
    include((t.left + t.right) / 2, range);
    include_centres(BisectionTree::child(t, 0), depth + 1, range);
    include_centres(BisectionTree::child(t, 1), depth + 1, range);
  }

  const GroundGrid& grid_;
  const BisectionTree& tree_;
  int depth_;
  std::vector<Range>& ranges_;
  glm::ivec2 low_{0}, high_{std::numeric_limits<int>::max()};
};

}  // namespace

TriangleBounds::TriangleBounds(const GroundGrid& grid, const BisectionTree& tree, Progress& progress)
    : depth_(std::clamp(tree.depth() - kLevelsUnderBounds, 1, kDeepestBounds)) {
  ranges_.resize(std::size_t{2} << depth_);
  const RangeFinder finder(grid, tree, depth_, ranges_);
  const int shared = std::min(depth_, 8);
  const NodeNumber first = first_node(shared);
  progress.begin("bounding triangles", first);
  tbb::parallel_for(first, 2 * first, [&](NodeNumber node) {
    finder.find(tree.triangle(node), shared, node);
    progress.advance();
  });
  for (NodeNumber node = first - 1; node >= 1; --node) {
    ranges_[node] = join(ranges_[2 * node], ranges_[2 * node + 1]);
  }
  progress.end();
}

void TriangleBounds::update(const GroundGrid& grid, const BisectionTree& tree, glm::ivec2 low,
                            glm::ivec2 high) {
  RangeFinder finder(grid, tree, depth_, ranges_);
  finder.limit(low, high);
  for (const NodeNumber half : {NodeNumber{2}, NodeNumber{3}}) finder.find(tree.triangle(half), 1, half);
  ranges_[1] = join(ranges_[2], ranges_[3]);
}

}  // namespace terrabench
