#include "lod/cbt/cbt.h"

#include <tbb/parallel_for.h>

#include <algorithm>

#include "terrain/memory.h"

namespace terrabench {

using cbt::NodeId, cbt::Place;
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

  bool wants_split(const Triangle& t) const {
    if (!t.splits()) return false;
    const rtin::Nested& nested = errors.at(t.middle());
    const glm::dvec3 middle = errors.position(t.middle());
    const bool coarse = cell > 0 ? cell * glm::distance(glm::dvec2(t.a), glm::dvec2(t.b)) >
                                       bound.length(middle, nested.radius)
                                 : nested.error > bound.allow(middle, nested.radius);
    return coarse && frustum.see(errors.box(t)) != Sight::kOutside;
  }
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
  for (NodeId k = 0; k < bisection_.roots(); ++k)
    draw(bisection_.at(bisection_.root(k)), Frustum::kAllPlanes, criterion.frustum);
  return frame_.finish(changes);
}

void Cbt::decide_all(const Criterion& criterion) {
  decisions_.resize(tree_.leaves());
  tbb::parallel_for(std::size_t{0}, decisions_.size(), [&](std::size_t number) {
    std::size_t leaf = number, leaves = decisions_.size();  // at or below the node
    const auto descend = [&](NodeId node) {
      const std::size_t left = tree_.sum(2 * node);
      const bool right = leaf >= left;
      leaf -= right ? left : 0;
      leaves = right ? leaves - left : left;
      return right;
    };
    NodeId root = 1;
    while (cbt::level_of(root) < bisection_.root_level()) root = 2 * root + (descend(root) ? 1 : 0);
    Place place = bisection_.at(root), parent;
    while (leaves > 1) {
      parent = place;
      place = place.half(descend(place.node));
    }
    decisions_[number] = decide(place, parent, criterion);
  });
}

// Within an update, a leaf decides otherwise than before only where the tree has changed.
void Cbt::decide_touched(const Criterion& criterion) {
  decisions_.resize(touched_.size());
  tbb::parallel_for(std::size_t{0}, touched_.size(), [&](std::size_t k) {
    const NodeId node = touched_[k];
    const Place parent = bisection_.at(node / 2);
    const bool is_leaf = tree_.is_split(parent.node) && !tree_.is_split(node);
    decisions_[k] = is_leaf ? decide(parent.half(node % 2 != 0), parent, criterion) : Decision{};
  });
}

Cbt::Decision Cbt::decide(const Place& leaf, const Place& parent, const Criterion& criterion) const {
  if (criterion.wants_split(leaf.triangle)) return {leaf.node, false};
  const bool left = leaf.node % 2 == 0;
  return left && parent.node != 0 && mergeable(parent, criterion) ? Decision{parent.node, true} : Decision{};
}

// Merges come first: a split undoes those in its way.
std::size_t Cbt::apply() {
  touched_.clear();
  std::size_t changes = 0;
  for (const Decision& decision : decisions_) changes += decision.merge ? merge(decision.node) : 0;
  for (const Decision& decision : decisions_)
    changes += decision.node != 0 && !decision.merge ? split(decision.node) : 0;
  return changes;
}

// For one of the two triangles of a diamond only.
bool Cbt::mergeable(const Place& parent, const Criterion& criterion) const {
  if (tree_.sum(parent.node) != 2 || criterion.wants_split(parent.triangle)) return false;
  if (parent.across == 0) return true;
  return parent.node < parent.across && tree_.sum(parent.across) == 2 &&
         !criterion.wants_split(bisection_.at(parent.across).triangle);
}

// Splits coarser neighbours first, so that the triangle across the hypotenuse is a leaf of the same level.
std::size_t Cbt::split(NodeId node) {
  if (tree_.is_split(node)) return 0;
  const NodeId across = bisection_.at(node).across;
  std::size_t changes = 0;
  if (across != 0 && cbt::level_of(across) > bisection_.root_level()) changes += split(across / 2);
  for (const NodeId half : {node, across}) {
    if (half == 0) continue;
    tree_.split(half);
    touched_.insert(touched_.end(), {2 * half, 2 * half + 1});
    ++changes;
  }
  return changes;
}

// The same merge may be decided twice, since two earlier merges may touch one leaf.
std::size_t Cbt::merge(NodeId node) {
  if (!tree_.is_split(node)) return 0;
  std::size_t changes = 0;
  for (const NodeId half : {node, bisection_.at(node).across}) {
    if (half == 0) continue;
    tree_.merge(half);
    ++changes;
    if (cbt::level_of(half) == bisection_.root_level()) continue;
    // The leaf that decides on the parent's diamond.
    const NodeId parent = half / 2, across = bisection_.at(parent).across;
    touched_.push_back(2 * (across == 0 ? parent : std::min(parent, across)));
  }
  return changes;
}

void Cbt::draw(const Place& place, unsigned planes, const Frustum& frustum) {
  const Triangle& t = place.triangle;
  if (t.splits() && planes != 0 && frustum.see(errors_.box(t), planes) == Sight::kOutside) return;
  if (tree_.is_split(place.node)) {
    draw(place.half(false), planes, frustum);
    draw(place.half(true), planes, frustum);
  } else if (const rtin::Lattice& lattice = errors_.lattice(); lattice.over_ground(t)) {
    for (const glm::ivec2 corner : {t.a, t.b, t.c}) frame_.add_corner(lattice.vertex(corner));
  }
}

Memory Cbt::memory() const {
  Memory memory = errors_.memory();
  memory.index += heap_bytes(this);
  memory += frame_.memory();
  memory += tree_.memory();
  memory += index_memory(decisions_, touched_);
  return memory;
}

}  // namespace terrabench
