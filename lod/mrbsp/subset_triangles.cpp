#include "lod/mrbsp/subset_triangles.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "lod/mrbsp/nearest_three.h"

namespace terrabench {
namespace {

// The printed recursion. The subsets of a triangle and its ancestors lie one after another in stack_.
class SubsetBuilder {
 public:
  SubsetBuilder(std::span<const glm::vec3> points, const BisectionTree& tree, bool shared)
      : points_(points), tree_(tree), shared_(shared), extent_(plan_extent(points)) {
    step_ = (extent_.high - extent_.low) / static_cast<float>(tree.side());
  }

  SubsetTriangles build() {
    result_.corners.reserve(3 * tree_.triangles());
    stack_.resize(points_.size());
    for (std::size_t i = 0; i < stack_.size(); ++i) stack_[i] = static_cast<std::uint32_t>(i);
    const auto roots = tree_.roots();
    for (int which = 0; which < 2; ++which) {
      const PlanTriangle& t = roots[which];
      // The square lies at sea level, so a half without points does too.
      with_half({0, points_.size()}, {t.left, t.right, t.apex}, which == 0, [&](Subset half) {
        descend(t, 1, half, {0, 0, 0});
      });
    }
    return std::move(result_);
  }

 private:
  using Heights = std::array<float, 3>;
  struct Subset {
    std::size_t begin, end;
  };
  // The vertical partitioning plane through two vertices, and a vertex on the side of the wanted half.
  struct Divider {
    glm::ivec2 from, to, on_side;
  };

  glm::vec2 place(glm::ivec2 at) const { return extent_.low + glm::vec2(at) * step_; }

  // Calls `body` with the part of a subset on one side of a divider.
  template <class Body>
  void with_half(Subset subset, const Divider& divider, bool takes_divider, const Body& body) {
    const glm::vec2 from = place(divider.from), along = place(divider.to) - from;
    const float this_side = plan_cross(along, place(divider.on_side) - from) > 0 ? 1.0F : -1.0F;
    // Points within a thousandth of a grid step count as on the divider: positions in metres are rounded.
    const float on_divider = 1e-3F * glm::length(along) * std::min(step_.x, step_.y);
    const std::size_t begin = stack_.size();
    for (std::size_t k = subset.begin; k < subset.end; ++k) {
      const std::uint32_t i = stack_[k];
      const float side = plan_cross(along, in_plan(points_[i]) - from) * this_side;
      const bool on = std::abs(side) <= on_divider;
      if (on ? takes_divider || shared_ : side > 0) stack_.push_back(i);
    }
    body({begin, stack_.size()});
    stack_.resize(begin);
  }

  Heights corner_heights(const PlanTriangle& t, Subset subset, const Heights& fallback) const {
    if (subset.begin == subset.end) return fallback;
    Heights heights;
    const std::array<glm::ivec2, 3> corners{t.apex, t.left, t.right};
    for (int c = 0; c < 3; ++c) {
      const glm::vec2 at = place(corners[c]);
      ThreePoints near;
      for (std::size_t k = subset.begin; k < subset.end; ++k) {
        const std::uint32_t i = stack_[k];
        const glm::vec2 to = in_plan(points_[i]) - at;
        near.offer(glm::dot(to, to), i, points_[i]);
      }
      heights[c] = near.height(at);
    }
    return heights;
  }

  void descend(const PlanTriangle& t, int depth, Subset subset, const Heights& fallback) {
    const Heights heights = corner_heights(t, subset, fallback);
    if (depth == tree_.depth()) {
      result_.starved += subset.end - subset.begin < 3;
      const std::array<glm::ivec2, 3> corners{t.apex, t.left, t.right};
      for (int c = 0; c < 3; ++c) {
        const glm::vec2 at = place(corners[c]);
        result_.corners.push_back({at.x, heights[c], at.y});
      }
      return;
    }
    const glm::ivec2 centre = (t.left + t.right) / 2;
    const float middle = 0.5F * (heights[1] + heights[2]);
    with_half(subset, {t.apex, centre, t.left}, true, [&](Subset half) {
      descend(BisectionTree::child(t, 0), depth + 1, half, {middle, heights[0], heights[1]});
    });
    with_half(subset, {t.apex, centre, t.right}, false, [&](Subset half) {
      descend(BisectionTree::child(t, 1), depth + 1, half, {middle, heights[2], heights[0]});
    });
  }

  std::span<const glm::vec3> points_;
  const BisectionTree& tree_;
  bool shared_;
  PlanExtent extent_;
  glm::vec2 step_{1};
  std::vector<std::uint32_t> stack_;
  SubsetTriangles result_;
};

}  // namespace

SubsetTriangles interpolate_subsets(std::span<const glm::vec3> points, const BisectionTree& tree,
                                    bool shared) {
  return SubsetBuilder(points, tree, shared).build();
}

VertexGaps vertex_gaps(const SubsetTriangles& triangles) {
  std::vector<glm::vec3> corners = triangles.corners;
  std::sort(corners.begin(), corners.end(), [](const glm::vec3& a, const glm::vec3& b) {
    return std::array{a.x, a.z, a.y} < std::array{b.x, b.z, b.y};
  });
  VertexGaps gaps;
  double sum = 0;
  for (std::size_t begin = 0, end = 0; begin < corners.size(); begin = end) {
    while (end < corners.size() && in_plan(corners[end]) == in_plan(corners[begin])) ++end;
    const double gap = double{corners[end - 1].y} - corners[begin].y;
    ++gaps.vertices;
    gaps.torn += gap > 0;
    sum += gap;
    gaps.largest = std::max(gaps.largest, gap);
  }
  gaps.mean = gaps.vertices > 0 ? sum / static_cast<double>(gaps.vertices) : 0;
  return gaps;
}

}  // namespace terrabench
