// Splits and merges, and the loop that chooses among them (Duchaineau et al. 1997, §5).
#include <algorithm>

#include "lod/roam/roam.h"

namespace terrabench {

using roam::kNone;
using roam::Node;
using roam::Spot;

void Roam::settle() {
  const auto full = [&](std::size_t more) {
    return options_.triangles > 0 && mesh_.leaves() + more > options_.triangles;
  };
  // Where lattice lines share samples, a triangle may have a slightly larger error than its parent had; then
  // two diamonds could take turns for ever.
  const std::size_t most_swaps = 2 * mesh_.leaves() + 1000;
  std::size_t swaps = 0;
  for (std::size_t step = 1;; ++step) {
    constexpr std::size_t kStepsPerLookAtTheClock = 32;
    if (step % kStepsPerLookAtTheClock == 0 && out_of_time()) return;
    if (full(0)) rank_pending();
    const int lowest = merges_.lowest(), highest = splits_.highest();
    if (lowest >= 0 && (lowest < kAsked || full(0))) {
      merge(merges_.first(lowest));
      continue;
    }
    if (highest < kAsked) return;
    const std::uint32_t id = splits_.first(highest);
    if (const std::size_t cost = cost_of_split(id); !full(cost)) {
      // Now, since to run out of memory half way would leave half a split.
      mesh_.make_room(cost);
      quiet_.resize(mesh_.nodes().size());
      fetch_ahead(id);
      split(id);
    } else if (!pending_.empty()) {
      rank_pending();
    } else if (lowest >= 0 && lowest < highest && swaps++ < most_swaps) {
      merge(merges_.first(lowest));
    } else {
      return;
    }
  }
}

// Keeps the reference where the queues meet. When they meet lower than it allowed for, priorities were put
// off that may count by now: they are all looked at, and there is more to settle.
bool Roam::lower_reference() {
  constexpr int kMargin =
      6;  // buckets; a wider one looks at more triangles a frame, a narrower one at all more often
  const int meeting = std::max(kAsked, splits_.highest());
  if (reference_ <= meeting) {
    if (reference_ < meeting - 2 * kMargin) reference_ = meeting - kMargin;
    return false;
  }
  reference_ = std::max(kAsked, meeting - kMargin);
  reconsider_all();
  return !out_of_time();
}

bool Roam::out_of_time() const {
  if (options_.milliseconds <= 0) return false;
  const std::chrono::duration<double, std::milli> spent = std::chrono::steady_clock::now() - start_;
  return spent.count() >= options_.milliseconds;
}

// Splits wait for memory more than for anything else: what those after this one in the queue will read is
// asked for now, step by step, since each step needs what the one before brings.
void Roam::fetch_ahead(std::uint32_t id) const {
  const std::vector<Node>& nodes = mesh_.nodes();
  const auto after = [&](std::uint32_t leaf) { return leaf == kNone ? kNone : nodes[leaf].queue.after; };
  const std::uint32_t first = after(id), second = after(first), third = after(second);
  mesh_.prefetch(third);
  if (second != kNone) {
    const Node& node = nodes[second];
    for (const std::uint32_t other : {node.left, node.right, node.base, node.parent}) mesh_.prefetch(other);
    mesh_.prefetch_split(node);
  }
  if (first != kNone && nodes[first].base != kNone) {
    const Node& base = nodes[nodes[first].base];
    for (const std::uint32_t other : {base.left, base.right, base.parent}) mesh_.prefetch(other);
  }
}

// Triangles that a split adds, or more: those of its base neighbours that must be split first included.
std::size_t Roam::cost_of_split(std::uint32_t id) const {
  const int finest = mesh_.lattice().finest_level();
  // A split of triangles on edge may force one more row of others, and that the same again at most.
  std::size_t cost = !mesh_.lattice().exact && mesh_.nodes()[id].level >= finest - 2
                         ? 8 * (static_cast<std::size_t>(finest) + 1)
                         : 0;
  for (;; id = mesh_.nodes()[id].base) {
    cost += mesh_.nodes()[id].base == kNone ? 1 : 2;
    if (mesh_.conforms_split(id)) return cost;
  }
}

void Roam::split(std::uint32_t id) {
  while (mesh_.nodes()[id].leaf() && !mesh_.conforms_split(id)) split(mesh_.nodes()[id].base);
  // A neighbour that stands on edge may have taken it along.
  if (mesh_.nodes()[id].leaf()) split_diamond(id);
}

void Roam::split_diamond(std::uint32_t id) {
  std::vector<Node>& nodes = mesh_.nodes();
  const std::array<std::uint32_t, 2> both = halves(id);
  for (const std::uint32_t half : both) {
    if (half == kNone) continue;
    take_off(half);
    drawn_.remove(nodes, half);
  }
  mesh_.split(id);
  ++changes_;
  quiet_.resize(nodes.size());
  const auto [at_apex, at_left, at_right] = mesh_.corners(nodes[id]).at;
  const Spot middle = camera_.spot(mesh_.apex(nodes[nodes[id].child]));
  const Spot left = camera_.spot(at_left), right = camera_.spot(at_right);
  add_children(id, camera_.spot(at_apex), left, right, middle);
  if (const std::uint32_t base = both[1]; base != kNone) {
    add_children(base, camera_.spot(mesh_.apex(nodes[base])), right, left, middle);
  }
  const std::uint32_t name = diamond(id);
  pending_.push_back(name);
  for (const std::uint32_t half : both) {
    if (half == kNone) continue;
    // Its parent's diamond can no longer merge, unless it is one that does not count. When its sibling has
    // been split the diamond could not before.
    const std::uint32_t parent = nodes[half].parent;
    if (parent == kNone || mesh_.on_edge(nodes[half])) continue;
    if (++nodes[parent].split_children == 1) take_off(diamond(parent));
  }
  bool on_edge = false;
  for (const std::uint32_t half : both) {
    if (half == kNone) continue;
    for (const std::uint32_t child : {nodes[half].child, nodes[half].child + 1}) {
      if (!mesh_.on_edge(nodes[child])) continue;
      on_edge = true;
      if (nodes[child].leaf()) split(child);
    }
  }
  // What its merge would take along counts at once, or they would take turns.
  if (on_edge) requeue_diamond(name);
}

// Corners of the parent, and the middle of its hypotenuse.
void Roam::add_children(std::uint32_t id, const Spot& apex, const Spot& left, const Spot& right,
                        const Spot& middle) {
  const Node& parent = mesh_.nodes()[id];
  const auto add = [&](std::uint32_t child, const Spot& a, const Spot& b) {
    see(child, parent.sight, {{middle.at, a.at, b.at}});
    disturb_ancestors(child);
    rank_leaf(child, distortion(mesh_.nodes()[child], middle, a, b));
  };
  add(parent.child, apex, left);
  add(parent.child + 1, right, apex);
}

void Roam::merge(std::uint32_t id) {
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
  const std::array<std::uint32_t, 2> both = halves(id);
  take_off(diamond(id));
  for (const std::uint32_t half : both) {
    if (half == kNone) continue;
    const std::uint32_t pair = mesh_.nodes()[half].child;
    for (const std::uint32_t child : {pair, pair + 1}) {
      take_off(child);
      drawn_.remove(mesh_.nodes(), child);
    }
  }
  mesh_.merge(id);
  ++changes_;
  for (const std::uint32_t half : both) {
    if (half == kNone) continue;
    const Node& node = mesh_.nodes()[half];
    rank_leaf(half, distortion(half, mesh_.corners(node)));
    if (node.parent == kNone) continue;
    if (!mesh_.on_edge(node)) --mesh_.nodes()[node.parent].split_children;
    requeue_diamond(node.parent);
  }
}

}  // namespace terrabench
