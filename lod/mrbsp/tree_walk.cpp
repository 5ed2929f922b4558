#include "lod/mrbsp/tree_walk.h"

#include <algorithm>
#include <glm/common.hpp>

namespace terrabench {
namespace {

std::array<std::uint16_t, 2> packed(glm::ivec2 at) {
  return {static_cast<std::uint16_t>(at.x), static_cast<std::uint16_t>(at.y)};
}
glm::ivec2 unpacked(std::array<std::uint16_t, 2> at) { return {at[0], at[1]}; }

}  // namespace

TreeWalk::TreeWalk(const Ground& ground, const LodRule& rule, const Eye& eye, const Scratch& scratch,
                   std::vector<std::uint32_t>& out)
    : ground_(ground),
      rule_(rule),
      eye_(eye),
      cuts_(scratch.cuts),
      whole_(scratch.whole),
      out_(out),
      hidden_depth_(eye.flags != nullptr ? eye.flags->depth() : 0),
      depth_(ground.tree.depth()),
      last_(ground.grid.width - 1, ground.grid.depth - 1) {}

void TreeWalk::run() {
  const auto roots = ground_.tree.roots();
  const unsigned planes = eye_.frustum != nullptr ? Frustum::kAllPlanes : 0;
  for (unsigned which = 0; which < 2; ++which) {
    const PlanTriangle& t = roots[which];
    descend(corner(t.apex), corner(t.left), corner(t.right), 1, 2 + which, planes);
  }
  if (cuts_ == nullptr) return;
  // The cuts are known now: what distance left whole is drawn as they say.
  for (const WholeTriangle& w : whole_) {
    settle({unpacked(w.apex), unpacked(w.left), unpacked(w.right)}, depth_of(w.node), w.node, w.planes);
  }
  whole_.clear();
  cuts_->clear();
}

std::uint32_t TreeWalk::vertex(glm::ivec2 at) const {
  const glm::ivec2 drawn_in = glm::min(at, last_);
  return static_cast<std::uint32_t>(drawn_in.y) * static_cast<std::uint32_t>(ground_.grid.width) +
         static_cast<std::uint32_t>(drawn_in.x);
}

TreeWalk::Corner TreeWalk::corner(glm::ivec2 at) const {
  const glm::ivec2 drawn_in = glm::min(at, last_);
  const glm::vec3 position(static_cast<float>(drawn_in.x) * ground_.grid.cell_x,
                           ground_.grid.heights[vertex(at)],
                           static_cast<float>(drawn_in.y) * ground_.grid.cell_z);
  return {at, rule_.threshold(eye_.at, position)};
}

// Is there anything to draw in the triangle? Takes the planes of the view out that it lies inside of.
bool TreeWalk::is_seen(const PlanTriangle& t, int depth, std::uint32_t node, unsigned& planes) const {
  const glm::ivec2 low = glm::min(glm::min(t.apex, t.left), t.right);
  if (low.x >= last_.x || low.y >= last_.y) return false;  // flat: beyond the border, drawn in to a line
  if (depth <= hidden_depth_ && !(*eye_.flags)[node]) return false;
  if (planes == 0 || depth > ground_.bounds.depth()) return true;
  const TriangleBounds::Range& range = ground_.bounds[node];
  const glm::ivec2 high = glm::min(glm::max(glm::max(t.apex, t.left), t.right), last_);
  const auto place = [&](glm::ivec2 at, float height) {
    return glm::vec3(static_cast<float>(at.x) * ground_.grid.cell_x, height,
                     static_cast<float>(at.y) * ground_.grid.cell_z);
  };
  return eye_.frustum->see({place(low, range.lowest), place(high, range.highest)}, planes) != Sight::kOutside;
}

void TreeWalk::descend(const Corner& apex, const Corner& left, const Corner& right, int depth,
                       std::uint32_t node, unsigned planes) {
  const PlanTriangle t{apex.at, left.at, right.at};
  if (!is_seen(t, depth, node, planes)) return;
  if (depth < std::min({depth_, apex.threshold, left.threshold, right.threshold})) {
    const Corner foot = corner((left.at + right.at) / 2);
    if (cuts_ != nullptr) cuts_->add(foot.at);
    descend(foot, apex, left, depth + 1, 2 * node, planes);
    descend(foot, right, apex, depth + 1, 2 * node + 1, planes);
  } else if (depth == depth_) {
    put(t);
  } else if (cuts_ != nullptr) {
    whole_.push_back({packed(t.apex), packed(t.left), packed(t.right), node, planes});
  } else if (may_open(apex.threshold, left.threshold, right.threshold, depth_)) {
    put(BisectionTree::child(t, 0));
    put(BisectionTree::child(t, 1));
  } else {
    put(t);
  }
}

// Draws a triangle that distance leaves whole, in the parts that its neighbours' cuts ask for.
void TreeWalk::settle(const PlanTriangle& t, int depth, std::uint32_t node, unsigned planes) {
  if (depth == depth_ || !cuts_->has((t.left + t.right) / 2)) {
    put(t);
    return;
  }
  for (unsigned which = 0; which < 2; ++which) {
    const PlanTriangle half = BisectionTree::child(t, which);
    unsigned left = planes;
    if (is_seen(half, depth + 1, 2 * node + which, left)) settle(half, depth + 1, 2 * node + which, left);
  }
}

void TreeWalk::put(const PlanTriangle& t) {
  const glm::ivec2 low = glm::min(glm::min(t.apex, t.left), t.right);
  if (low.x >= last_.x || low.y >= last_.y) return;
  for (const glm::ivec2 at : {t.apex, t.left, t.right}) out_.push_back(vertex(at));
}

}  // namespace terrabench
