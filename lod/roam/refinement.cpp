// The refinement of the mesh (Duchaineau et al. 1997, §5). First, in call order: the loop that splits and
// merges until the queues agree, one split, and what ends the frame. Then one merge, helpers of both, what is
// incidental (cost, degenerate triangles, clock, prefetching), and the priorities that order the queues.
#include <algorithm>
#include <bit>
#include <cmath>

#include "lod/roam/roam.h"

namespace terrabench {

using roam::Distortion;
using roam::kNone;
using roam::Node;
using roam::Validity;
using roam::ViewedCorner;

namespace {

constexpr double kBucketShare = 1 / (1 + 1.0 / 16);  // lower / upper end of the widest bucket
constexpr std::size_t kPrefetch = 16;                // prefetch distance, in nodes

}  // namespace

// Merges while the lowest diamond is below max_error or the mesh is too large; splits while the highest leaf
// is above. At the limit on triangles, merges the lowest diamond to make room for the highest leaf.
void Roam::refine() {
  // Whether the mesh exceeds its limit with this many triangles more.
  const auto full = [&](std::size_t more) {
    return options_.triangles > 0 && mesh_.leaves() + more > options_.triangles;
  };
  // Where lattice lines share samples, a triangle's error may slightly exceed its parent's. Without a limit,
  // two diamonds could then be swapped forever.
  const std::size_t most_swaps = 2 * mesh_.leaves() + 1000;
  std::size_t swaps = 0;
  for (std::size_t step = 1;; ++step) {
    constexpr std::size_t kStepsPerClockReading = 32;
    if (step % kStepsPerClockReading == 0 && out_of_time()) return;
    if (full(0)) queue_split_diamonds();  // a diamond split in this frame may be the lowest
    const int lowest = merges_.lowest(), highest = splits_.highest();
    if (lowest >= 0 && (lowest < kMaxErrorBucket || full(0))) {
      force_merge(merges_.first(lowest));
      continue;
    }
    if (highest < kMaxErrorBucket) return;
    const std::uint32_t id = splits_.first(highest);
    if (const std::size_t cost = cost_of_split(id); !full(cost)) {
      grow_nodes(cost);  // before the split: it must not fail half-way for lack of memory
      prefetch_next_splits(id);
      force_split(id);
    } else if (!split_diamonds_.empty()) {
      queue_split_diamonds();  // no room: one of them may be the lowest
    } else if (lowest >= 0 && lowest < highest && swaps++ < most_swaps) {
      force_merge(merges_.first(lowest));
    } else {
      return;
    }
  }
}

// Room for this many more leaves, in all that is held per node.
void Roam::grow_nodes(std::size_t leaves) {
  mesh_.make_room(leaves);
  labels_valid_until_.resize(mesh_.nodes().size());
}

// Splits the triangle's diamond. While its base neighbour is one level coarser, with another triangle as its
// own base neighbour, the two form no diamond: then that neighbour is split first, and one of its children
// becomes the triangle's base neighbour.
void Roam::force_split(std::uint32_t id) {
  while (mesh_.nodes()[id].leaf() && !mesh_.forms_diamond(id)) force_split(mesh_.nodes()[id].base);
  // Splitting a degenerate neighbour may already have split this triangle.
  if (mesh_.nodes()[id].leaf()) split_diamond(id);
}

// In this order: takes both halves out of the split queue and the draw list (before they cease to be leaves:
// unqueue() chooses the queue by that); bisects them; labels and ranks the children; notes the diamond in
// split_diamonds_, from where queue_split_diamonds() enters it into the merge queue; takes the parents'
// diamonds out of that queue. The children enter the draw list in finish_ranked_leaves().
void Roam::split_diamond(std::uint32_t id) {
  std::vector<Node>& nodes = mesh_.nodes();
  const Halves both = halves(id);
  for (const std::uint32_t half : both) {
    if (half == kNone) continue;
    unqueue(half);
    drawn_.remove(nodes, half);
  }
  mesh_.bisect_diamond(id);
  ++changes_;
  const auto [at_apex, at_left, at_right] = mesh_.corners(nodes[id]).at;
  const ViewedCorner middle = view_.corner(mesh_.apex(nodes[nodes[id].child]));
  const ViewedCorner left = view_.corner(at_left), right = view_.corner(at_right);
  add_children(id, view_.corner(at_apex), left, right, middle);
  if (const std::uint32_t base = both[1]; base != kNone) {  // seen from it, left and right change places
    add_children(base, view_.corner(mesh_.apex(nodes[base])), right, left, middle);
  }
  split_diamonds_.push_back(diamond_of(id));
  withdraw_parents(both);
  split_degenerate_children(both);
}

// Labels and ranks the two children of a triangle, given by its corners and the middle of its hypotenuse.
// rank_leaf() enters each into ranked_leaves_ and, unless it has no error, into the split queue, in the
// bucket of its error in pixels / max_error.
void Roam::add_children(std::uint32_t id, const ViewedCorner& apex, const ViewedCorner& left,
                        const ViewedCorner& right, const ViewedCorner& middle) {
  const Node& parent = mesh_.nodes()[id];
  const auto add = [&](std::uint32_t child, const ViewedCorner& a, const ViewedCorner& b) {
    set_label(child, parent.label, {{middle.at, a.at, b.at}});
    limit_ancestors(child);
    rank_leaf(child, distortion(mesh_.nodes()[child], middle, a, b));
  };
  add(parent.child, apex, left);
  add(parent.child + 1, right, apex);
}

// A diamond cannot merge while a child of either half is split, unless that child is degenerate. Split
// children are counted per half, but the merge queue has one entry per diamond: it may have been removed
// already.
void Roam::withdraw_parents(const Halves& both) {
  std::vector<Node>& nodes = mesh_.nodes();
  for (const std::uint32_t half : both) {
    if (half == kNone) continue;
    const std::uint32_t parent = nodes[half].parent;
    if (parent == kNone || mesh_.degenerate(nodes[half])) continue;
    if (++nodes[parent].split_children == 1) unqueue(diamond_of(parent));
  }
}

// Most diamonds split in a frame have children split in the same frame and cannot merge, so they enter the
// merge queue only when merging is considered, and after refine().
void Roam::queue_split_diamonds() {
  const std::vector<Node>& nodes = mesh_.nodes();
  for (std::size_t k = 0; k < split_diamonds_.size(); ++k) {
    if (k + 2 * kPrefetch < split_diamonds_.size()) mesh_.prefetch(split_diamonds_[k + 2 * kPrefetch]);
    if (k + kPrefetch < split_diamonds_.size()) mesh_.prefetch(nodes[split_diamonds_[k + kPrefetch]].base);
    const std::uint32_t id = split_diamonds_[k];
    const Node& node = nodes[id];
    if (node.in_use && !node.leaf()) requeue_diamond(id);
  }
  split_diamonds_.clear();
}

// Most leaves made in a frame are split in the same frame, so only those left at the end of update() are
// drawn and deferred.
void Roam::finish_ranked_leaves() {
  std::vector<Node>& nodes = mesh_.nodes();
  for (std::size_t k = ranked_leaves_.size(); k-- > 0;) {
    if (k >= kPrefetch) mesh_.prefetch(ranked_leaves_[k - kPrefetch]);
    const std::uint32_t id = ranked_leaves_[k];
    const Node& node = nodes[id];
    if (!node.in_use || !node.leaf()) continue;
    update_drawn(id);
    if (node.bucket == roam::kNoList || node.deferral_list != roam::kNoList) continue;
    deferred_.defer(nodes, id, node.validity);
  }
  ranked_leaves_.clear();
}

// Merges the diamonds of degenerate children, then the diamond itself.
void Roam::force_merge(std::uint32_t id) {
  for (const std::uint32_t half : halves(id)) {
    if (half == kNone) continue;
    const std::uint32_t pair = mesh_.nodes()[half].child;
    for (const std::uint32_t child : {pair, pair + 1}) {
      if (!mesh_.nodes()[child].leaf()) merge_diamond(child);
    }
  }
  merge_diamond(id);
}

void Roam::merge_diamond(std::uint32_t id) {
  const Halves both = halves(id);
  unqueue(diamond_of(id));
  for (const std::uint32_t half : both) {
    if (half == kNone) continue;
    const std::uint32_t pair = mesh_.nodes()[half].child;
    for (const std::uint32_t child : {pair, pair + 1}) {
      unqueue(child);
      drawn_.remove(mesh_.nodes(), child);
    }
  }
  mesh_.join_diamond(id);
  ++changes_;
  for (const std::uint32_t half : both) {
    if (half == kNone) continue;
    const Node& node = mesh_.nodes()[half];
    rank_leaf(half, distortion(half, mesh_.corners(node)));
    if (node.parent == kNone) continue;
    if (!mesh_.degenerate(node)) --mesh_.nodes()[node.parent].split_children;
    requeue_diamond(node.parent);
  }
}

std::uint32_t Roam::diamond_of(std::uint32_t id) const {
  const std::uint32_t base = mesh_.nodes()[id].base;
  return base == kNone ? id : std::min(id, base);
}

bool Roam::mergeable(std::uint32_t id) const {
  for (const std::uint32_t half : halves(id)) {
    if (half == kNone) continue;
    const Node& node = mesh_.nodes()[half];
    if (node.split_children > 0 || mesh_.degenerate(node)) return false;
  }
  return true;
}

// Ranks the diamond of a split triangle in the merge queue again, or removes it if it cannot merge.
void Roam::requeue_diamond(std::uint32_t id) {
  if (id == kNone) return;
  const std::uint32_t diamond = diamond_of(id);
  unqueue(diamond);
  if (mergeable(diamond)) rank_diamond(diamond);
}

// From its queue, which the mesh tells, and from its deferral list. In neither of them: no effect.
void Roam::unqueue(std::uint32_t id) {
  (mesh_.nodes()[id].leaf() ? splits_ : merges_).remove(mesh_.nodes(), id);
  deferred_.remove(mesh_.nodes(), id);
}

// Upper bound of the triangles that force_split() adds.
std::size_t Roam::cost_of_split(std::uint32_t id) const {
  const int finest = mesh_.lattice().finest_level();
  // Splitting a degenerate child may force a further chain of neighbours, two triangles per level, whose
  // splits may do the same. Four chains are a safe bound (roam_cost_test.cpp).
  std::size_t cost = !mesh_.lattice().exact && mesh_.nodes()[id].level >= finest - 2
                         ? 8 * (static_cast<std::size_t>(finest) + 1)
                         : 0;
  for (;; id = mesh_.nodes()[id].base) {
    cost += mesh_.nodes()[id].base == kNone ? 1 : 2;
    if (mesh_.forms_diamond(id)) return cost;
  }
}

// Degenerate triangles occur only where the lattice is not exact (lattice.h). A merge would include them, so
// the diamond is ranked with them now; otherwise split and merge would alternate forever.
void Roam::split_degenerate_children(const Halves& both) {
  const std::vector<Node>& nodes = mesh_.nodes();
  bool any = false;
  for (const std::uint32_t half : both) {
    if (half == kNone) continue;
    for (const std::uint32_t child : {nodes[half].child, nodes[half].child + 1}) {
      if (!mesh_.degenerate(nodes[child])) continue;
      any = true;
      if (nodes[child].leaf()) force_split(child);
    }
  }
  if (any) requeue_diamond(both[0]);
}

bool Roam::out_of_time() const {
  if (options_.milliseconds <= 0) return false;
  const std::chrono::duration<double, std::milli> spent = std::chrono::steady_clock::now() - start_;
  return spent.count() >= options_.milliseconds;
}

// Splits are limited by memory latency. Prefetches what the next three leaves of the queue will read, one
// step of indirection per split.
void Roam::prefetch_next_splits(std::uint32_t id) const {
  const std::vector<Node>& nodes = mesh_.nodes();
  const auto after = [&](std::uint32_t leaf) { return leaf == kNone ? kNone : nodes[leaf].queue.after; };
  const std::uint32_t first = after(id), second = after(first), third = after(second);
  mesh_.prefetch(third);
  if (second != kNone) {
    const Node& node = nodes[second];
    for (const std::uint32_t other : {node.left, node.right, node.base, node.parent}) mesh_.prefetch(other);
    mesh_.prefetch_bisection(node);
  }
  if (first != kNone && nodes[first].base != kNone) {
    const Node& base = nodes[nodes[first].base];
    for (const std::uint32_t other : {base.left, base.right, base.parent}) mesh_.prefetch(other);
  }
}

std::uint16_t Roam::bucket_of(double ratio) {
  const auto value = static_cast<float>(ratio);
  if (!(value > 0)) return 0;
  const int bucket = static_cast<int>(std::bit_cast<std::uint32_t>(value) >> 19) - kFirstBucket;
  return static_cast<std::uint16_t>(std::clamp(bucket, 0, kBuckets - 1));
}

double Roam::lowest_ratio(int bucket) {
  return std::bit_cast<float>(static_cast<std::uint32_t>(bucket + kFirstBucket) << 19);
}

Distortion Roam::distortion(const Node& node, const ViewedCorner& a, const ViewedCorner& b,
                            const ViewedCorner& c) const {
  if (!node.visible() || node.thickness == 0) return {};
  return view_.distortion(a, b, c, node.thickness);
}

Distortion Roam::distortion(std::uint32_t id, const roam::Corners& corners) const {
  const auto [a, b, c] = corners.at;
  return distortion(mesh_.nodes()[id], view_.corner(a), view_.corner(b), view_.corner(c));
}

// How long until the error may have changed by the factor `share`, up or down; rounded to the early side.
Validity Roam::validity(const Distortion& now, double share) {
  return {static_cast<float>(0.9999 * (1 - share) * now.scale), static_cast<float>(1.0001 * now.reach)};
}

// A leaf without error is in no queue: splitting it gains nothing. Also lists the leaf for
// finish_ranked_leaves(). `validity` shares memory with the deferral links, so the leaf must not be deferred.
void Roam::rank_leaf(std::uint32_t id, const Distortion& now) {
  std::vector<Node>& nodes = mesh_.nodes();
  ranked_leaves_.push_back(id);
  deferred_.remove(nodes, id);
  if (now.pixels == 0) return splits_.remove(nodes, id);
  const double ratio = now.pixels / options_.max_error;
  if (const std::uint16_t bucket = bucket_of(ratio); bucket != nodes[id].bucket) {
    splits_.remove(nodes, id);
    splits_.push(nodes, id, bucket);
  }
  // Below exact_from_, the priority is valid until it may have risen to that bucket; above, until it may have
  // changed by a bucket.
  const double share = ratio / lowest_ratio(exact_from_);
  nodes[id].validity = validity(now, share < 1 ? share : kBucketShare);
}

// Puts a diamond into the merge queue, by the largest error of all triangles that force_merge() would
// restore.
void Roam::rank_diamond(std::uint32_t id) {
  Distortion now;
  const auto include = [&](std::uint32_t part) {
    const Distortion other = distortion(part, mesh_.corners(mesh_.nodes()[part]));
    if (other.pixels > now.pixels) now = other;
  };
  for (const std::uint32_t half : halves(id)) {
    if (half == kNone) continue;
    include(half);
    for (const std::uint32_t child : {mesh_.nodes()[half].child, mesh_.nodes()[half].child + 1}) {
      const Node& node = mesh_.nodes()[child];
      if (!node.leaf() && node.base != kNone) include(node.base);  // a degenerate child's diamond
    }
  }
  const double ratio = now.pixels / options_.max_error;
  merges_.push(mesh_.nodes(), id, bucket_of(ratio));
  if (now.pixels == 0) return;  // valid until its culling label changes
  deferred_.defer(mesh_.nodes(), id,
                  validity(now, std::min(lowest_ratio(exact_from_) / ratio, kBucketShare)));
}

void Roam::rerank(std::uint32_t id) {
  const Node& node = mesh_.nodes()[id];
  if (node.leaf()) {
    rank_leaf(id, distortion(id, mesh_.corners(node)));
    return;
  }
  requeue_diamond(id);
  // If the base neighbour is degenerate, re-rank its parent's diamond, whose merge includes it.
  if (node.base != kNone && mesh_.degenerate(mesh_.nodes()[node.base])) {
    requeue_diamond(mesh_.nodes()[node.base].parent);
  }
}

void Roam::rerank_expired() {
  const std::vector<Node>& nodes = mesh_.nodes();
  for (std::size_t k = 0; k < expired_.size(); ++k) {
    if (k + 2 * kPrefetch < expired_.size()) mesh_.prefetch(expired_[k + 2 * kPrefetch]);
    if (k + kPrefetch < expired_.size()) mesh_.prefetch_corners(nodes[expired_[k + kPrefetch]]);
    rerank(expired_[k]);
  }
}

void Roam::rerank_all() {
  const std::size_t made = first_ ? mesh_.roots() : mesh_.nodes().size();
  for (std::uint32_t id = 0; id < made; ++id) {
    if (mesh_.nodes()[id].in_use) rerank(id);
  }
}

// Keeps exact_from_ a little below the bucket where the two queues meet. Returns whether it had to be
// lowered: then deferred priorities may matter, all are computed again, and refinement must continue.
bool Roam::lower_exact_bucket() {
  constexpr int kMargin = 6;  // buckets; a wider one re-ranks more triangles per frame, a narrower one all of
                              // them more often
  const int meeting = std::max(kMaxErrorBucket, splits_.highest());
  if (exact_from_ <= meeting) {
    if (exact_from_ < meeting - 2 * kMargin) exact_from_ = meeting - kMargin;
    return false;
  }
  exact_from_ = std::max(kMaxErrorBucket, meeting - kMargin);
  rerank_all();
  return !out_of_time();
}

}  // namespace terrabench
