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
      descend(corner(t.apex), corner(t.left), corner(t.right), 1, 2 + which, planes);
    }
    if (splits_ == nullptr) return;
    // All split vertices are known now.
    for (const PendingTriangle& w : pending_) {
      draw_pending({unpacked(w.apex), unpacked(w.left), unpacked(w.right)}, depth_of(w.node), w.node,
                   w.planes);
    }
    pending_.clear();
    splits_->clear();
  }

 private:
  struct Corner {
    glm::ivec2 at;  // may lie beyond the field
    int threshold;
  };

  std::uint32_t vertex(glm::ivec2 at) const {
    const glm::ivec2 clamped = glm::min(at, last_);
    return static_cast<std::uint32_t>(clamped.y) * static_cast<std::uint32_t>(grid_.width) +
           static_cast<std::uint32_t>(clamped.x);
  }
  Corner corner(glm::ivec2 at) const {
    const glm::ivec2 clamped = glm::min(at, last_);
    const glm::vec3 position(static_cast<float>(clamped.x) * grid_.cell_x, grid_.heights[vertex(at)],
                             static_cast<float>(clamped.y) * grid_.cell_z);
    return {at, rule_.threshold(eye_, position)};
  }

  // Whether anything in the triangle may be drawn. Removes the planes that the triangle lies inside of.
  bool is_seen(const PlanTriangle& t, int depth, std::uint32_t node, unsigned& planes) const {
    const glm::ivec2 low = glm::min(glm::min(t.apex, t.left), t.right);
    if (low.x >= last_.x || low.y >= last_.y) return false;  // beyond the field: no plan area
    if (depth <= hidden_depth_ && !(*flags_)[node]) return false;
    if (planes == 0 || depth > bounds_.depth()) return true;
    const TriangleBounds::Range& range = bounds_[node];
    const glm::ivec2 high = glm::min(glm::max(glm::max(t.apex, t.left), t.right), last_);
    const Bounds box{
        {static_cast<float>(low.x) * grid_.cell_x, range.lowest, static_cast<float>(low.y) * grid_.cell_z},
        {static_cast<float>(high.x) * grid_.cell_x, range.highest,
         static_cast<float>(high.y) * grid_.cell_z}};
    return frustum_->see(box, planes) != Sight::kOutside;
  }

  void descend(const Corner& apex, const Corner& left, const Corner& right, int depth, std::uint32_t node,
               unsigned planes) {
    const PlanTriangle t{apex.at, left.at, right.at};
    if (!is_seen(t, depth, node, planes)) return;
    if (depth < std::min({depth_, apex.threshold, left.threshold, right.threshold})) {
      const Corner centre = corner((left.at + right.at) / 2);
      if (splits_ != nullptr) splits_->add(centre.at);
      descend(centre, apex, left, depth + 1, 2 * node, planes);
      descend(centre, right, apex, depth + 1, 2 * node + 1, planes);
    } else if (splits_ != nullptr && depth < depth_) {
      pending_.push_back({packed(t.apex), packed(t.left), packed(t.right), node, planes});
    } else if (printed_rule_ && depth < depth_ &&
               may_open(apex.threshold, left.threshold, right.threshold, depth_)) {
      put(BisectionTree::child(t, 0));
      put(BisectionTree::child(t, 1));
    } else {
      put(t);
    }
  }

  // Draws a triangle that the LOD rule does not split, in the parts that the split vertices require.
  void draw_pending(const PlanTriangle& t, int depth, std::uint32_t node, unsigned planes) {
    if (depth == depth_ || !splits_->has((t.left + t.right) / 2)) {
      put(t);
      return;
    }
    for (unsigned which = 0; which < 2; ++which) {
      const PlanTriangle half = BisectionTree::child(t, which);
      unsigned left = planes;
      if (is_seen(half, depth + 1, 2 * node + which, left))
        draw_pending(half, depth + 1, 2 * node + which, left);
    }
  }

  void put(const PlanTriangle& t) {
    const glm::ivec2 low = glm::min(glm::min(t.apex, t.left), t.right);
    if (low.x >= last_.x || low.y >= last_.y) return;
    for (const glm::ivec2 at : {t.apex, t.left, t.right}) out_.push_back(vertex(at));
  }

  static std::array<std::uint16_t, 2> packed(glm::ivec2 at) {
    return {static_cast<std::uint16_t>(at.x), static_cast<std::uint16_t>(at.y)};
  }
  static glm::ivec2 unpacked(std::array<std::uint16_t, 2> at) { return {at[0], at[1]}; }

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
