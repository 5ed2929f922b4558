// A triangle of the bintrees, one cache line, and the lists that triangles are members of. Geometry is
// implicit: apex, heading and level give the three corners.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "terrain/memory.h"

namespace terrabench::roam {

inline constexpr std::uint32_t kNone = 0xFFFFFFFFU;
inline constexpr std::uint16_t kNoList = 0xFFFFU;

// A place in a doubly linked list.
struct Links {
  std::uint32_t before = kNone, after = kNone;
};

// How far the camera may move before a priority must be looked at again, and how far from the eye the wedgie
// may lie now. Metres.
struct Patience {
  float slack, reach;
};

// Which of the view's planes a triangle's wedgie lies wholly inside of, a bit each, or that it lies outside
// of one.
using Sight = std::uint8_t;
inline constexpr Sight kAllInside = 0x3F, kOutside = 0x40;
// All below a triangle that lies wholly inside or outside does so too.
inline bool inherited(Sight parent) { return parent == kAllInside || (parent & kOutside) != 0; }

// Corners: the apex at the right angle, then left and right of whoever looks from it along the heading (as
// the map shows it, z down). Neighbours share the edges apex-left, apex-right and left-right (base). In a
// triangle that is split only the base neighbour is kept up to date: the other half of its diamond.
struct alignas(64) Node {
  std::int32_t u = 0, v = 0;  // lattice point of the apex
  float thickness = 0;        // of the wedgie, metres
  std::uint32_t left = kNone, right = kNone, base = kNone;
  std::uint32_t child = kNone;   // the left one; the right one follows it
  std::uint32_t parent = kNone;  // or the next free pair
  Links queue;                   // among leaves to split, or among diamonds to merge
  union {
    Links wait{};       // among those whose priority is looked at again at the same time
    Patience patience;  // of a leaf that has just been ranked
  };
  std::uint32_t slot = kNone;  // in the draw list
  std::uint16_t bucket = kNoList, due = kNoList;
  std::uint8_t level = 0, heading = 0;
  Sight sight = kOutside;  // nothing is drawn of it yet
  bool in_use = true;
  std::uint8_t split_children = 0;  // those that stand on edge do not count

  bool leaf() const { return child == kNone; }
  bool visible() const { return (sight & kOutside) == 0; }
};
static_assert(sizeof(Node) == 64);

// A table of lists over nodes, each node in one list at most. All operations are O(1); highest() and lowest()
// look at one bit a list, 64 at a time.
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

  // Empties a list and appends what was in it.
  void clear(std::vector<Node>& nodes, std::uint16_t list, std::vector<std::uint32_t>& members) {
    for (std::uint32_t id = heads_[list]; id != kNone; id = (nodes[id].*kLinks).after) {
      nodes[id].*kList = kNoList;
      members.push_back(id);
    }
    heads_[list] = kNone;
    used_[list / 64] &= ~(std::uint64_t{1} << (list % 64));
  }

  std::uint32_t first(int list) const { return heads_[static_cast<std::size_t>(list)]; }

  // Of the lists that hold something; -1 when none does.
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

  Memory memory() const {
    Memory memory = index_memory(heads_);
    memory += index_memory(used_);
    return memory;
  }

 private:
  std::vector<std::uint32_t> heads_;
  std::vector<std::uint64_t> used_;
};

using PriorityQueue = NodeLists<&Node::queue, &Node::bucket>;
using WaitingLists = NodeLists<&Node::wait, &Node::due>;

}  // namespace terrabench::roam
