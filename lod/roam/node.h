// A triangle of the binary triangle trees, in one cache line, and the lists that triangles belong to.
// Geometry is implicit: apex, heading and level determine the three corners.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "terrain/memory.h"

namespace terrabench::roam {

inline constexpr std::uint32_t kNone = 0xFFFFFFFFU;
inline constexpr std::uint16_t kNoList = 0xFFFFU;

// Neighbours in a doubly linked list.
struct Links {
  std::uint32_t before = kNone, after = kNone;
};

// How long a priority stays valid: until the camera's moved + ρ·turned (see Motion) exceeds `motion`, where ρ
// is `reach`, the present distance from the eye to the farthest point of the wedgie. Metres.
struct Validity {
  float motion, reach;
};

// Culling label (§6.2): bit i is set when the wedgie lies wholly inside plane i of the view, kOutside when it
// lies wholly outside of one plane.
using CullLabel = std::uint8_t;
inline constexpr CullLabel kAllInside = 0x3F, kOutside = 0x40;
// Whether all descendants of a triangle with this label have it too.
inline bool inherited(CullLabel parent) { return parent == kAllInside || (parent & kOutside) != 0; }

// Corners: the apex at the right angle; left and right as seen from the apex along the heading, the direction
// (of kSteps) from the apex to the middle of the hypotenuse, on a map with z pointing down. The neighbours
// left, right and base share the edges apex-left, apex-right and left-right (the hypotenuse). In a split
// triangle only the base neighbour, the other half of its diamond, is kept up to date.
struct alignas(64) Node {
  std::int32_t u = 0, v = 0;  // lattice point of the apex
  float thickness = 0;        // of the wedgie, metres
  std::uint32_t left = kNone, right = kNone, base = kNone;
  std::uint32_t child = kNone;   // the left one; the right one is child + 1
  std::uint32_t parent = kNone;  // in an unused pair: the next unused pair
  Links queue;                   // in the split queue (leaves) or the merge queue (diamonds)
  union {
    Links deferral{};   // in the deferral list
    Validity validity;  // until the end of the frame in which a leaf was ranked
  };
  std::uint32_t slot = kNone;  // in the draw list
  std::uint16_t bucket = kNoList, deferral_list = kNoList;
  std::uint8_t level = 0, heading = 0;
  CullLabel label = kOutside;  // until the first update
  bool in_use = true;
  std::uint8_t split_children = 0;  // children that are split, except degenerate ones

  bool leaf() const { return child == kNone; }
  bool visible() const { return (label & kOutside) == 0; }
};
static_assert(sizeof(Node) == 64);

// A table of lists of nodes; each node is in one list at most. All operations are O(1), except that highest()
// and lowest() scan one bit per list, 64 at a time, and drain() visits the list's members.
template <Links Node::*kLinks, std::uint16_t Node::*kList>
class NodeLists {
 public:
  explicit NodeLists(int lists)
      : heads_(static_cast<std::size_t>(lists), kNone), used_((static_cast<std::size_t>(lists) + 63) / 64) {}

  void push(std::vector<Node>& nodes, std::uint32_t id, std::uint16_t list) {
    Node& node = nodes[id];
    node.*kList = list;
    (node.*kLinks) = {kNone, heads_[list]};
    if (heads_[list] != kNone) (nodes[heads_[list]].*kLinks).before = id;
    heads_[list] = id;
    used_[list / 64] |= std::uint64_t{1} << (list % 64);
  }

  void remove(std::vector<Node>& nodes, std::uint32_t id) {
    Node& node = nodes[id];
    const std::uint16_t list = node.*kList;
    if (list == kNoList) return;
    const Links links = node.*kLinks;
    if (links.after != kNone) (nodes[links.after].*kLinks).before = links.before;
    if (links.before != kNone) {
      (nodes[links.before].*kLinks).after = links.after;
    } else {
      heads_[list] = links.after;
      if (links.after == kNone) used_[list / 64] &= ~(std::uint64_t{1} << (list % 64));
    }
    node.*kList = kNoList;
  }

  // Empties a list and appends its members to `members`.
  void drain(std::vector<Node>& nodes, std::uint16_t list, std::vector<std::uint32_t>& members) {
    for (std::uint32_t id = heads_[list]; id != kNone; id = (nodes[id].*kLinks).after) {
      nodes[id].*kList = kNoList;
      members.push_back(id);
    }
    heads_[list] = kNone;
    used_[list / 64] &= ~(std::uint64_t{1} << (list % 64));
  }

  std::uint32_t first(int list) const { return heads_[static_cast<std::size_t>(list)]; }

  // Number of the highest or lowest list that is not empty; -1 when all are empty.
  int highest() const {
    for (std::size_t word = used_.size(); word-- > 0;) {
      if (used_[word] != 0) return static_cast<int>(word * 64) + 63 - std::countl_zero(used_[word]);
    }
    return -1;
  }
  int lowest() const {
    for (std::size_t word = 0; word < used_.size(); ++word) {
      if (used_[word] != 0) return static_cast<int>(word * 64) + std::countr_zero(used_[word]);
    }
    return -1;
  }

  Memory memory() const { return index_memory(heads_, used_); }

 private:
  std::vector<std::uint32_t> heads_;
  std::vector<std::uint64_t> used_;
};

using PriorityQueue = NodeLists<&Node::queue, &Node::bucket>;
using DeferralTable = NodeLists<&Node::deferral, &Node::deferral_list>;

}  // namespace terrabench::roam
