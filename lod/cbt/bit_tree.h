// A binary tree of at most `depth` levels as one bit per node of the deepest level, and the sums of these
// bits over every node above (Dupuy, "Concurrent Binary Trees", 2020, §3). Nodes are numbered as in a heap,
// from 1 at the root. Each leaf has one set bit, that of its leftmost descendant in the deepest level; so a
// node without children sums to 1, and the n-th leaf is found by descending along the sums. Node n of level l
// is stored in depth - l + 1 bits: in all 2^(depth - 1) bytes, however many leaves there are.
//
// The paper sums all bits anew after each pass, in parallel. Here few bits change per pass, and each changes
// the sums above it: O(depth) per change.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "terrain/memory.h"

namespace terrabench::cbt {

using NodeId = std::uint64_t;  // 0: no node

inline int level_of(NodeId node) { return std::bit_width(node) - 1; }

class BitTree {
 public:
  // Without leaves. 1 ≤ depth ≤ 40
  explicit BitTree(int depth) : depth_(depth), words_(((std::size_t{4} << depth) + 63) / 64) {}

  int depth() const { return depth_; }
  std::size_t leaves() const { return sum(1); }
  // The leaves in and below a node.
  std::size_t sum(NodeId node) const {
    const Place at = place(node);
    std::uint64_t bits = words_[at.word] >> at.shift;
    if (at.shift + at.bits > 64) bits |= words_[at.word + 1] << (64 - at.shift);
    return bits & ((std::uint64_t{1} << at.bits) - 1);
  }
  bool is_split(NodeId node) const { return level_of(node) < depth_ && sum(2 * node + 1) > 0; }
  // A leaf of its own, which must not be below another.
  void add_leaf(NodeId node) { add_to_sums(node, 1); }
  // Arguments: a leaf; the parent of two leaves.
  void split(NodeId node) { add_to_sums(2 * node + 1, 1); }
  void merge(NodeId node) { add_to_sums(2 * node + 1, ~std::uint64_t{0}); }
  std::span<const std::uint64_t> words() const { return words_; }
  Memory memory() const { return index_memory(words_); }

 private:
  struct Place {
    std::size_t word;
    unsigned shift, bits;
  };
  Place place(NodeId node) const {
    const int level = level_of(node);
    const auto bits = static_cast<unsigned>(depth_ - level + 1);
    const std::size_t first = (std::size_t{2} << level) + node * bits;
    return {first / 64, static_cast<unsigned>(first % 64), bits};
  }
  // Adds modulo 2^64 to the bit of the node's leftmost descendant and all sums above; none overflows.
  void add_to_sums(NodeId node, std::uint64_t number) {
    for (NodeId n = node << (depth_ - level_of(node)); n > 0; n /= 2) {
      const Place at = place(n);
      const std::uint64_t mask = (std::uint64_t{1} << at.bits) - 1, value = (sum(n) + number) & mask;
      words_[at.word] = (words_[at.word] & ~(mask << at.shift)) | value << at.shift;
      if (at.shift + at.bits <= 64) continue;
      const unsigned low = 64 - at.shift;
      words_[at.word + 1] = (words_[at.word + 1] & ~(mask >> low)) | value >> low;
    }
  }

  int depth_;
  std::vector<std::uint64_t> words_;
};

}  // namespace terrabench::cbt
