// Inspects the state of a Roam: every invariant that must hold between two updates.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <vector>

#include "lod/roam/roam.h"

namespace terrabench {

struct RoamAudit {
  const Roam& roam;
  std::vector<std::string> problems{};

  static std::size_t leaves(const Roam& roam) { return roam.mesh_.leaves(); }
  static double extent(const Roam& roam) { return roam.extent_; }
  static int exact_from(const Roam& roam) { return roam.exact_from_; }
  static int max_error_bucket() { return Roam::kMaxErrorBucket; }
  static int highest_leaf_bucket(const Roam& roam) { return roam.splits_.highest(); }

  struct Diamond {
    int bucket, present;  // where the merge queue holds it, and the bucket of its present priority
  };
  // All in the merge queue. The lattice must be exact.
  static std::vector<Diamond> diamonds(const Roam& roam) {
    std::vector<Diamond> diamonds;
    for (int bucket = 0; bucket < Roam::kBuckets; ++bucket) {
      for (auto id = roam.merges_.first(bucket); id != roam::kNone; id = roam.mesh_.nodes()[id].queue.after) {
        double largest = 0;
        for (const std::uint32_t half : roam.halves(id)) {
          if (half == roam::kNone) continue;
          const roam::Corners corners = roam.mesh_.corners(roam.mesh_.nodes()[half]);
          largest = std::max(largest, roam.distortion(half, corners).pixels);
        }
        diamonds.push_back({bucket, Roam::bucket_of(largest / roam.options_.max_error)});
      }
    }
    return diamonds;
  }

  // The first broken invariant; empty when all hold.
  static std::string first_problem(const Roam& roam) {
    RoamAudit audit{roam};
    audit.trees();
    audit.queue(roam.splits_, true);
    audit.queue(roam.merges_, false);
    audit.drawn();
    return audit.problems.empty() ? "" : audit.problems.front();
  }

 private:
  using Node = roam::Node;
  const std::vector<Node>& nodes() const { return roam.mesh_.nodes(); }

  template <class... Args>
  void check(bool holds, fmt::format_string<Args...> text, Args&&... args) {
    if (!holds) problems.push_back(fmt::format(text, std::forward<Args>(args)...));
  }

  void trees() {
    std::size_t leaves = 0, reached = 0;
    for (std::uint32_t id = 0; id < roam.mesh_.roots(); ++id) tree(id, 0, leaves, reached);
    check(leaves == roam.mesh_.leaves(), "{} leaves counted as {}", leaves, roam.mesh_.leaves());
    std::size_t used = 0;
    for (const Node& node : nodes()) used += node.in_use ? 1 : 0;
    check(used == reached, "{} nodes in use, {} reached", used, reached);
  }

  void tree(std::uint32_t id, roam::CullLabel parent, std::size_t& leaves, std::size_t& reached) {
    const Node& node = nodes()[id];
    ++reached;
    check(node.in_use, "node {} is free", id);
    const bool inherited = parent == roam::kAllInside || (parent & roam::kOutside) != 0;
    const roam::CullLabel label =
        inherited
            ? parent
            : roam.view_.cull(roam.mesh_.corners(node), node.thickness, roam.mesh_.spill(node), parent).label;
    check(node.label == label, "node {} has label {:x}, not {:x}", id, node.label, label);
    if (node.leaf()) {
      ++leaves;
      leaf(id);
      return;
    }
    check(node.base == roam::kNone || nodes()[node.base].base == id,
          "half {} is not the base of its base neighbour", id);
    check(node.base == roam::kNone || !nodes()[node.base].leaf(), "half {} is split alone", id);
    const bool queued = roam.diamond_of(id) == id && roam.mergeable(id);
    check(queued == (node.bucket != roam::kNoList), "diamond {}: mergeable {}", id, queued);
    int split_children = 0;
    for (const std::uint32_t child : {node.child, node.child + 1}) {
      split_children += !nodes()[child].leaf() && !roam.mesh_.degenerate(nodes()[child]);
    }
    check(node.split_children == split_children, "node {} counts {} split children, not {}", id,
          node.split_children, split_children);
    for (const std::uint32_t child : {node.child, node.child + 1}) {
      check(nodes()[child].parent == id, "child {} has a wrong parent", child);
      check(nodes()[child].level == node.level + 1, "child {} has a wrong level", child);
      tree(child, node.label, leaves, reached);
    }
  }

  void leaf(std::uint32_t id) {
    const Node& node = nodes()[id];
    const auto [apex, right, left] = roam.mesh_.vertices(node);
    across(id, node.left, apex, left);
    across(id, node.right, apex, right);
    across(id, node.base, left, right);
    check(!roam.mesh_.degenerate(node), "leaf {} is degenerate", id);
    const bool empty = roam.mesh_.empty({apex, right, left});
    check((node.slot != roam::kNone) == (node.visible() && !empty), "leaf {}: drawn {}", id,
          node.slot != roam::kNone);
    const roam::Distortion now =
        roam.mesh_.splittable(node) ? roam.distortion(id, roam.mesh_.corners(node)) : roam::Distortion{};
    check((now.pixels > 0) == (node.bucket != roam::kNoList), "leaf {} of {} px in bucket {}", id, now.pixels,
          node.bucket);
    if (now.pixels == 0) return;
    check(node.deferral_list != roam::kNoList, "leaf {} is not deferred", id);
    const double ratio = now.pixels / roam.options_.max_error;
    if (node.bucket < roam.exact_from_) {
      // If exact_from_ has risen past it since it was ranked, its priority may have changed by 1/16.
      const double bound = std::max(Roam::lowest_ratio(roam.exact_from_),
                                    Roam::lowest_ratio(node.bucket + 1) * (1 + 1.0 / 16));
      check(ratio < bound * (1 + 1e-6), "leaf {} has risen to a ratio of {}", id, ratio);
    } else {
      check(std::abs(Roam::bucket_of(ratio) - node.bucket) <= 1, "leaf {} of bucket {} is in bucket {}", id,
            Roam::bucket_of(ratio), node.bucket);
    }
  }

  void across(std::uint32_t id, std::uint32_t other, std::uint32_t a, std::uint32_t b) {
    if (other == roam::kNone) {
      const GroundGrid& grid = roam.mesh_.grid();
      const auto width = static_cast<std::uint32_t>(grid.width),
                 last = static_cast<std::uint32_t>(grid.depth) - 1;
      const bool border = (a % width == b % width && (a % width == 0 || a % width == width - 1)) ||
                          (a / width == b / width && (a / width == 0 || a / width == last));
      check(border, "leaf {} has no neighbour inside the field", id);
      return;
    }
    const Node& node = nodes()[other];
    check(node.leaf() && node.in_use, "neighbour {} of leaf {} is not a leaf", other, id);
    check((node.left == id) + (node.right == id) + (node.base == id) == 1,
          "neighbour {} does not refer to {}", other, id);
    const auto vertices = roam.mesh_.vertices(node);
    const std::set<std::uint32_t> theirs(vertices.begin(), vertices.end());
    check(theirs.contains(a) && theirs.contains(b), "leaves {} and {} share no edge", id, other);
  }

  void queue(const roam::PriorityQueue& queue, bool of_leaves) {
    std::size_t held = 0;
    int highest = -1, lowest = -1;
    for (int list = 0; list < Roam::kBuckets; ++list) {
      std::uint32_t before = roam::kNone;
      for (std::uint32_t id = queue.first(list); id != roam::kNone; id = nodes()[id].queue.after) {
        check(nodes()[id].bucket == list && nodes()[id].leaf() == of_leaves, "node {} is in a wrong list",
              id);
        check(nodes()[id].queue.before == before, "list {} is broken at {}", list, id);
        if (lowest < 0) lowest = list;
        highest = list;
        before = id;
        if (++held > nodes().size()) return check(false, "list {} is cyclic", list);
      }
    }
    check(queue.highest() == highest && queue.lowest() == lowest,
          "lowest and highest lists {} and {}, not {} and {}", queue.lowest(), queue.highest(), lowest,
          highest);
    std::size_t members = 0;
    for (const Node& node : nodes()) {
      members += node.in_use && node.leaf() == of_leaves && node.bucket != roam::kNoList ? 1 : 0;
    }
    check(held == members, "{} nodes in the queue, {} with a bucket", held, members);
  }

  void drawn() {
    const std::span<const std::uint32_t> indices = roam.drawn_.indices();
    for (std::size_t slot = 0; slot < roam.drawn_.triangles(); ++slot) {
      const std::uint32_t id = roam.drawn_.owner(slot);
      check(id != roam::kNone && nodes()[id].slot == slot, "slot {} has no owner", slot);
      if (id == roam::kNone) return;
      const auto vertices = roam.mesh_.vertices(nodes()[id]);
      check(std::equal(vertices.begin(), vertices.end(),
                       indices.begin() + static_cast<std::ptrdiff_t>(3 * slot)),
            "slot {} holds another triangle", slot);
    }
    check(indices.size() == 3 * roam.drawn_.triangles(), "{} indices are not three per triangle",
          indices.size());
  }
};

}  // namespace terrabench
