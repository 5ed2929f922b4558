#include "lod/cbt/cbt.h"

#include <tbb/parallel_for.h>

#include <algorithm>

#include "lod/cbt/leaf_walk.h"
#include "terrain/memory.h"

namespace terrabench {

using cbt::Diamond, cbt::NodeId, cbt::Place;
using rtin::Triangle;

namespace {

constexpr std::string_view kSplits[] = {"error", "edge"};

cbt::BitTree empty_tree(int depth) {
  require_memory((std::size_t{1} << depth) / 2, "the bits of cbt");
  return cbt::BitTree(depth);
}

}  // namespace

struct Cbt::Criterion {
  const rtin::NestedErrors& errors;
  ScreenBound bound;
  Frustum frustum;
  float cell;  // the longer side of one, for lengths of edges; 0: by error

  // The same for both triangles of a diamond.
  bool is_coarse(const Triangle& t) const {
    if (!t.splits()) return false;
    const rtin::Nested& nested = errors.at(t.middle());
    const glm::dvec3 middle = errors.position(t.middle());
    return cell > 0
               ? cell * glm::distance(glm::dvec2(t.a), glm::dvec2(t.b)) > bound.length(middle, nested.radius)
               : nested.error > bound.allow(middle, nested.radius);
  }
  // Of a triangle with t.splits().
  bool is_in_view(const Triangle& t) const { return frustum.see(errors.box(t)) != Sight::kOutside; }
};

std::span<const ParameterSpec> Cbt::parameters() {
  static const ParameterSpec kSpecs[] = {
      choice("split", kSplits, "what must show as at most the knob's pixels: the error, or the longest edge"),
      {"passes", std::int64_t{0}, "", "most passes per update, of one level each; 0: until nothing changes",
       0, 100},
  };
  return kSpecs;
}

std::unique_ptr<Lod> Cbt::build(const LodGround& from, const Parameters& parameters, Progress& progress) {
  check_ground(from.heights);
  const Options options{parameters.choice("split") == 1, static_cast<int>(parameters.integer("passes"))};
  return std::make_unique<Cbt>(from.heights, options, progress);
}

Cbt::Cbt(const Heightfield& ground, const Options& options, Progress& progress)
    : options_(options),
      errors_(grid_of(ground), true, progress),
      bisection_(errors_.lattice()),
      tree_(empty_tree(bisection_.depth())),
      frame_(ground) {
  for (NodeId k = 0; k < bisection_.roots(); ++k) tree_.add_leaf(bisection_.root(k));
}

void Cbt::edited(const SampleRect& rect) {
  frame_.edited(rect);
  errors_.update(rect.low, rect.high);
}

const Frame& Cbt::update(const View& view) {
  check_view(view);
  const Criterion criterion{errors_, ScreenBound(view, pixels_), Frustum(view),
                            options_.by_edge ? std::max(frame_.grid().cell_x, frame_.grid().cell_z) : 0};
  decide_all(criterion);
  std::size_t changes = apply();
  for (int passes = 1; passes != options_.passes && !touched_.empty(); ++passes) {
    decide_touched(criterion);
    changes += apply();
  }
  frame_.begin();
  draw(criterion.frustum);
  return frame_.finish(changes);
}

// Calls make(first, last, part) for ranges of leaves, in parallel.
template <class Make>
void Cbt::make_parts(const Make& make) {
  constexpr std::size_t kMost = 64, kLeaves = 512;
  const std::size_t leaves = tree_.leaves();
  parts_.resize(std::max(parts_.size(), std::clamp<std::size_t>(leaves / kLeaves, 1, kMost)));
  const std::size_t parts = parts_.size();
  tbb::parallel_for(std::size_t{0}, parts,
                    [&](std::size_t k) { make(leaves * k / parts, leaves * (k + 1) / parts, parts_[k]); });
}

void Cbt::decide_all(const Criterion& criterion) {
  struct State {
    unsigned planes = Frustum::kAllPlanes;
    InView in_view{.known = true};
  };
  const auto enter = [&](const Triangle& t, State& state) {
    state.in_view.parent = state.in_view.leaf;
    if (state.in_view.leaf && state.planes != 0 && t.splits()) {
      state.in_view.leaf = criterion.frustum.see(errors_.box(t), state.planes) != Sight::kOutside;
    }
    return true;
  };
  make_parts([&](std::size_t first, std::size_t last, Part& part) {
    part.decisions.clear();
    const auto use = [&](const Place& leaf, const Place& parent, std::size_t of_parent, const State& state) {
      const Decision decision = decide(leaf.node, leaf.triangle, parent.diamond(), of_parent, state.in_view,
                                       criterion, [&] { return leaf.across; });
      if (decision.diamond.node != 0) part.decisions.push_back(decision);
    };
    cbt::walk_leaves<State>(bisection_, tree_, first, last, enter, use);
  });
  decisions_.clear();
  for (const Part& part : parts_)
    decisions_.insert(decisions_.end(), part.decisions.begin(), part.decisions.end());
}

// Within an update, a leaf decides otherwise than before only where the tree has changed.
void Cbt::decide_touched(const Criterion& criterion) {
  decisions_.assign(2 * touched_.size(), {});
  tbb::parallel_for(std::size_t{0}, decisions_.size(), [&](std::size_t k) {
    const auto& [parent, both] = touched_[k / 2];
    const NodeId leaf = 2 * parent.node + k % 2;
    if ((k % 2 != 0 && !both) || !tree_.is_split(parent.node) || tree_.is_split(leaf)) return;
    const auto halves = parent.triangle.halves();
    decisions_[k] = decide(leaf, k % 2 == 0 ? halves.first : halves.second, parent, tree_.sum(parent.node),
                           {}, criterion, [&] { return bisection_.at(leaf).across; });
  });
}

template <class AcrossLeaf>
Cbt::Decision Cbt::decide(NodeId leaf, const Triangle& triangle, const Diamond& parent, std::size_t of_parent,
                          const InView& in_view, const Criterion& criterion,
                          const AcrossLeaf& across_leaf) const {
  if (in_view.leaf && criterion.is_coarse(triangle) && (in_view.known || criterion.is_in_view(triangle)))
    return {{leaf, across_leaf(), triangle}, false};
  if (leaf % 2 == 0 && mergeable(parent, of_parent, in_view, criterion)) return {parent, true};
  return {};
}

// Merges come first: a split undoes those in its way.
std::size_t Cbt::apply() {
  touched_.clear();
  std::size_t changes = 0;
  for (const Decision& decision : decisions_) changes += decision.merge ? merge(decision.diamond) : 0;
  for (const Decision& decision : decisions_)
    changes += decision.diamond.node != 0 && !decision.merge ? split(decision.diamond) : 0;
  return changes;
}

// True for one triangle of a diamond only; is_coarse() is the same for both.
bool Cbt::mergeable(const Diamond& parent, std::size_t leaves, const InView& in_view,
                    const Criterion& criterion) const {
  if (leaves != 2) return false;
  const bool alone = parent.across == 0;
  if (!alone && (parent.node > parent.across || tree_.sum(parent.across) != 2)) return false;
  if (!criterion.is_coarse(parent.triangle)) return true;
  if (in_view.parent && (in_view.known || criterion.is_in_view(parent.triangle))) return false;
  return alone || !criterion.is_in_view(parent.mirrored().triangle);
}

// Splits coarser neighbours first, so that the triangle across the hypotenuse is a leaf of the same level.
std::size_t Cbt::split(const Diamond& diamond) {
  if (tree_.is_split(diamond.node)) return 0;
  std::size_t changes = 0;
  if (diamond.across != 0 && cbt::level_of(diamond.across) > bisection_.root_level() &&
      !tree_.is_split(diamond.across / 2)) {
    changes += split(bisection_.at(diamond.across / 2).diamond());
  }
  for (const Diamond& half : {diamond, diamond.mirrored()}) {
    if (half.node == 0) continue;
    tree_.split(half.node);
    touched_.push_back({half, true});
    ++changes;
  }
  return changes;
}

// The same merge may be decided twice, since two earlier merges may touch one leaf.
std::size_t Cbt::merge(const Diamond& diamond) {
  if (!tree_.is_split(diamond.node)) return 0;
  std::size_t changes = 0;
  for (const NodeId half : {diamond.node, diamond.across}) {
    if (half == 0) continue;
    tree_.merge(half);
    ++changes;
    if (cbt::level_of(half) == bisection_.root_level()) continue;
    const Diamond parent = bisection_.at(half / 2).diamond();
    // The leaf that decides on the parent's diamond.
    const bool other = parent.across != 0 && parent.across < parent.node;
    touched_.push_back({other ? parent.mirrored() : parent, false});
  }
  return changes;
}

void Cbt::draw(const Frustum& frustum) {
  struct State {
    unsigned planes = Frustum::kAllPlanes;
  };
  const rtin::Lattice& lattice = errors_.lattice();
  const auto enter = [&](const Triangle& t, State& state) {
    return !t.splits() || state.planes == 0 || frustum.see(errors_.box(t), state.planes) != Sight::kOutside;
  };
  make_parts([&](std::size_t first, std::size_t last, Part& part) {
    part.corners.clear();
    const auto use = [&](const Place& leaf, const Place&, std::size_t, const State&) {
      const Triangle& t = leaf.triangle;
      if (!lattice.over_ground(t)) return;
      for (const glm::ivec2 corner : {t.a, t.b, t.c}) part.corners.push_back(lattice.vertex(corner));
    };
    cbt::walk_leaves<State>(bisection_, tree_, first, last, enter, use);
  });
  for (const Part& part : parts_) frame_.add_corners(part.corners);
}

SplitGround Cbt::split_ground() const {
  const rtin::Lattice& lattice = errors_.lattice();
  const glm::ivec2 size = lattice.size();
  SplitGround ground{.grid = frame_.grid(),
                     .roots = lattice.roots,
                     .side_log = lattice.side_log,
                     .depth = tree_.depth(),
                     .errors = {},
                     .radii = {},
                     .tree = tree_.words()};
  for (glm::ivec2 at{0}; at.y < size.y; ++at.y) {
    for (at.x = 0; at.x < size.x; ++at.x) {
      ground.errors.push_back(errors_.at(at).error);
      ground.radii.push_back(errors_.at(at).radius);
    }
  }
  return ground;
}

SplitRule Cbt::split_rule(const View& view) const {
  check_view(view);
  return {ScreenBound(view, pixels_).terms(), Frustum(view).planes()};
}

Memory Cbt::memory() const {
  Memory memory = errors_.memory();
  memory.index += heap_bytes(this);
  memory += frame_.memory();
  memory += tree_.memory();
  memory += index_memory(decisions_, touched_);
  memory.index += heap_bytes(parts_.data());
  for (const Part& part : parts_) memory += index_memory(part.decisions, part.corners);
  return memory;
}

}  // namespace terrabench
