#include "lod/mrbsp/tree_walk.h"

#include <algorithm>
#include <glm/common.hpp>

namespace terrabench {
namespace {

// All functions are defined in the class, so they are inlined; otherwise a walk takes a third longer.
class TreeWalk {
 public:
  TreeWalk(const WalkGround& ground, const LodRule& rule, const WalkEye& eye, const WalkScratch& scratch,
           std::vector<std::uint32_t>& out)
      : grid_(ground.grid),
        tree_(ground.tree),
        bounds_(ground.bounds),
        rule_(rule),
        eye_(eye.at),
        frustum_(eye.frustum),
        flags_(eye.flags),
        splits_(scratch.splits),
        pending_(scratch.pending),
        printed_rule_(scratch.printed_rule),
        out_(out),
        hidden_depth_(eye.flags != nullptr ? eye.flags->depth() : 0),
        depth_(ground.tree.depth()),
        last_(grid_.width - 1, grid_.depth - 1) {}

  void run() {
    const auto roots = tree_.roots();
    const unsigned planes = frustum_ != nullptr ? Frustum::kAllPlanes : 0;
    for (unsigned which = 0; which < 2; ++which) {
      const PlanTriangle& t = roots[which];
      descend(corner(pack(t.apex)), corner(pack(t.left)), corner(pack(t.right)), 1, 2 + which, planes);
    }
    if (splits_ == nullptr) return;
    splits_->close();
    for (const PendingTriangle& w : pending_) {
      draw_pending(w.apex, w.left, w.right, w.node, w.planes);
    }
    pending_.clear();
    splits_->clear();
  }

 private:
  // A vertex in one register, x + y · 2³², so that the walk moves whole words: two halves stored one by one
  // and loaded at once would wait for each other. May lie beyond the field.
  using Vertex = std::uint64_t;
  static Vertex pack(glm::ivec2 at) { return static_cast<std::uint32_t>(at.x) | Vertex(at.y) << 32; }
  static int x(Vertex v) { return static_cast<int>(v & 0xFFFFFFFFU); }
  static int y(Vertex v) { return static_cast<int>(v >> 32); }
  static Vertex middle(Vertex a, Vertex b) { return (a + b) / 2; }  // sums of hypotenuses are even

  struct Corner {
    Vertex at;
    int threshold;
  };
  struct Triangle {
    Vertex apex, left, right;
  };
  struct Rect {
    int low_x, low_y, high_x, high_y;
  };
  static Rect extent(const Triangle& t) {
    return {std::min({x(t.apex), x(t.left), x(t.right)}), std::min({y(t.apex), y(t.left), y(t.right)}),
            std::max({x(t.apex), x(t.left), x(t.right)}), std::max({y(t.apex), y(t.left), y(t.right)})};
  }

  std::uint32_t vertex(Vertex at) const {
    return static_cast<std::uint32_t>(std::min(y(at), last_.y)) * static_cast<std::uint32_t>(grid_.width) +
           static_cast<std::uint32_t>(std::min(x(at), last_.x));
  }
  Corner corner(Vertex at) const {
    const glm::vec3 position(static_cast<float>(std::min(x(at), last_.x)) * grid_.cell_x,
                             grid_.heights[vertex(at)],
                             static_cast<float>(std::min(y(at), last_.y)) * grid_.cell_z);
    return {at, rule_.threshold(eye_, position)};
  }

  // Whether anything in the triangle may be drawn. Removes the planes that the triangle lies inside of.
  bool is_seen(const Triangle& t, int depth, std::uint32_t node, unsigned& planes) const {
    const Rect rect = extent(t);
    if (rect.low_x >= last_.x || rect.low_y >= last_.y) return false;  // beyond the field: no plan area
    if (depth <= hidden_depth_ && !(*flags_)[node]) return false;
    if (planes == 0 || depth > bounds_.depth()) return true;
    return frustum_->see(box(rect, node), planes) != Sight::kOutside;
  }

  // Around the ground of a node's subtree.
  Bounds box(const Rect& rect, std::uint32_t node) const {
    const TriangleBounds::Range& range = bounds_[node];
    return {{static_cast<float>(rect.low_x) * grid_.cell_x, range.lowest,
             static_cast<float>(rect.low_y) * grid_.cell_z},
            {static_cast<float>(std::min(rect.high_x, last_.x)) * grid_.cell_x, range.highest,
             static_cast<float>(std::min(rect.high_y, last_.y)) * grid_.cell_z}};
  }

  // Whether nothing in the subtree of a triangle in view is culled and all its vertices have the same
  // threshold up to depth_. The nearest and the farthest point of its box bound them, to the bit: every step
  // of the formula is monotone.
  bool is_uniform(const Triangle& t, int depth, std::uint32_t node, unsigned planes) const {
    if (depth < hidden_depth_ || depth > bounds_.depth() || (planes != 0 && depth < bounds_.depth()))
      return false;
    const Rect rect = extent(t);
    if (rect.high_x > last_.x || rect.high_y > last_.y) return false;
    const Bounds around = box(rect, node);
    glm::vec3 farthest;
    for (int axis = 0; axis < 3; ++axis) {
      const bool beyond = eye_[axis] - around.low[axis] > around.high[axis] - eye_[axis];
      farthest[axis] = beyond ? around.low[axis] : around.high[axis];
    }
    const auto threshold = [&](const glm::vec3& at) { return std::min(rule_.threshold(eye_, at), depth_); };
    return threshold(glm::clamp(eye_, around.low, around.high)) == threshold(farthest);
  }

  void descend(Corner apex, Corner left, Corner right, int depth, std::uint32_t node, unsigned planes) {
    const Triangle t{apex.at, left.at, right.at};
    if (!is_seen(t, depth, node, planes)) return;
    const int threshold = std::min({depth_, apex.threshold, left.threshold, right.threshold});
    if (depth >= threshold) {
      const bool opens = printed_rule_ && may_open(apex.threshold, left.threshold, right.threshold, depth_);
      end_at(t, depth, node, planes, opens);
    } else if (is_uniform(t, depth, node, planes)) {
      split_to(t.apex, t.left, t.right, threshold - depth, node, planes);
    } else {
      const Corner centre = corner(middle(left.at, right.at));
      prefetch_below(t, depth, node);
      add_split(t);
      descend(centre, apex, left, depth + 1, 2 * node, planes);
      descend(centre, right, apex, depth + 1, 2 * node + 1, planes);
    }
  }

  // The heights at which the halves are split, if they can be, and the bounds of their halves.
  void prefetch_below(const Triangle& t, int depth, std::uint32_t node) const {
    if (depth + 1 >= tree_.depth()) return;
    __builtin_prefetch(&grid_.heights[vertex(middle(t.apex, t.left))]);
    __builtin_prefetch(&grid_.heights[vertex(middle(t.apex, t.right))]);
    if (depth + 2 <= bounds_.depth()) __builtin_prefetch(&bounds_[4 * node]);
  }

  // Splits a triangle with a uniform subtree; no vertex is looked at.
  void split_to(Vertex apex, Vertex left, Vertex right, int levels, std::uint32_t node, unsigned planes) {
    for (; levels > 0; --levels, node = 2 * node + 1) {
      add_split({apex, left, right});
      const Vertex centre = middle(left, right);
      split_to(centre, apex, left, levels - 1, 2 * node, planes);
      left = right;  // the other half
      right = apex;
      apex = centre;
    }
    end_at({apex, left, right}, depth_of(node), node, planes, false);
  }

  void add_split(const Triangle& t) {
    if (splits_ != nullptr) splits_->add({at(t.apex), at(t.left), at(t.right)});
  }
  static glm::ivec2 at(Vertex v) { return {x(v), y(v)}; }

  // A triangle that the LOD rule does not split. `opens`: by the printed rule.
  void end_at(const Triangle& t, int depth, std::uint32_t node, unsigned planes, bool opens) {
    if (splits_ != nullptr && depth < depth_) {
      pending_.push_back({t.apex, t.left, t.right, node, planes});
    } else if (opens && depth < depth_) {
      const Vertex centre = middle(t.left, t.right);
      put({centre, t.apex, t.left});
      put({centre, t.right, t.apex});
    } else {
      put(t);
    }
  }

  // Draws a triangle that the LOD rule does not split, in the parts that the split vertices require.
  void draw_pending(Vertex apex, Vertex left, Vertex right, std::uint32_t node, unsigned planes) {
    const int depth = depth_of(node);
    const Vertex centre = middle(left, right);
    if (depth == depth_ || !splits_->has(at(centre))) {
      put({apex, left, right});
      return;
    }
    unsigned of_left = planes, of_right = planes;
    if (is_seen({centre, apex, left}, depth + 1, 2 * node, of_left))
      draw_pending(centre, apex, left, 2 * node, of_left);
    if (is_seen({centre, right, apex}, depth + 1, 2 * node + 1, of_right))
      draw_pending(centre, right, apex, 2 * node + 1, of_right);
  }

  void put(const Triangle& t) {
    const Rect rect = extent(t);
    if (rect.low_x >= last_.x || rect.low_y >= last_.y) return;
    for (const Vertex at : {t.apex, t.left, t.right}) out_.push_back(vertex(at));
  }

  const GroundGrid& grid_;
  const BisectionTree& tree_;
  const TriangleBounds& bounds_;
  LodRule rule_;
  glm::vec3 eye_;
  const Frustum* frustum_;
  const mrbsp::visibility::Flags* flags_;
  SplitVertices* splits_;
  std::vector<PendingTriangle>& pending_;
  bool printed_rule_;
  std::vector<std::uint32_t>& out_;
  int hidden_depth_;  // the flags end at this depth
  int depth_;
  glm::ivec2 last_;
};

}  // namespace

void walk_tree(const WalkGround& ground, const LodRule& rule, const WalkEye& eye, const WalkScratch& scratch,
               std::vector<std::uint32_t>& out) {
  TreeWalk(ground, rule, eye, scratch, out).run();
}

}  // namespace terrabench
