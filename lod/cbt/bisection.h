// The triangles of longest-edge bisection as nodes of a binary tree (Dupuy 2020, §4), over a lattice of any
// number of root squares. The roots are the first nodes of the first level that has room for them. A node's
// number gives its triangle and neighbours: its bits choose the halves. O(level) per node.
#pragma once

#include <array>
#include <bit>
#include <cstdint>

#include "lod/cbt/bit_tree.h"
#include "lod/rtin/lattice.h"

namespace terrabench::cbt {

// A triangle and the one across its hypotenuse, with which it is split and merged.
struct Diamond {
  NodeId node = 0, across = 0;  // across: 0 at the border
  rtin::Triangle triangle{};    // of the node

  Diamond mirrored() const {
    const auto& [a, b, c] = triangle;
    return {across, node, {b, a, a + b - c}};
  }
};

// A node, its triangle, and the nodes of the same level across its three sides: from a to b (the hypotenuse),
// b to c and c to a. Each of these is 0 at the border.
struct Place {
  NodeId node = 0;
  rtin::Triangle triangle;
  NodeId across = 0, beside_b = 0, beside_a = 0;

  Diamond diamond() const { return {node, across, triangle}; }
  // The left half shares the leg at a, the right half that at b; legs of two neighbours share the apex.
  Place half(bool right) const {
    const auto [left_half, right_half] = triangle.halves();
    const auto child = [](NodeId parent, unsigned which) { return parent == 0 ? 0 : 2 * parent + which; };
    if (right) return {2 * node + 1, right_half, child(beside_b, 0), 2 * node, child(across, 0)};
    return {2 * node, left_half, child(beside_a, 1), child(across, 1), 2 * node + 1};
  }
};

class Bisection {
 public:
  explicit Bisection(const rtin::Lattice& lattice) : lattice_(lattice) {}

  NodeId roots() const { return NodeId{2} * lattice_.roots.x * lattice_.roots.y; }
  int root_level() const { return std::bit_width(roots() - 1); }
  int depth() const { return root_level() + 2 * lattice_.side_log; }
  NodeId root(NodeId number) const { return (NodeId{1} << root_level()) + number; }

  // The node must be a root or below one.
  Place at(NodeId node) const {
    int below = level_of(node) - root_level();
    Place place = place_of_root((node >> below) - root(0));
    while (below-- > 0) place = place.half((node >> below & 1) != 0);
    return place;
  }

 private:
  Place place_of_root(NodeId number) const {
    const int square = static_cast<int>(number / 2), x = square % lattice_.roots.x,
              z = square / lattice_.roots.x;
    const bool falling = (x + z) % 2 == 0, second = number % 2 != 0;
    std::array<rtin::Triangle, 2> halves;
    std::size_t made = 0;
    const int side = 1 << lattice_.side_log;
    rtin::Lattice::halves_of_square(glm::ivec2(x, z) * side, side,
                                    [&](const rtin::Triangle& t) { halves[made++] = t; });
    // Squares of the other diagonal lie around. Where the diagonal falls, the first half has the north and
    // the east side; where it rises, the north and the west side.
    const NodeId north = half_of(x, z - 1, 1), south = half_of(x, z + 1, 0);
    const NodeId west = half_of(x - 1, z, falling ? 1 : 0), east = half_of(x + 1, z, falling ? 0 : 1);
    const NodeId other = root(number ^ 1), node = root(number);
    if (falling)
      return second ? Place{node, halves[1], other, west, south} : Place{node, halves[0], other, east, north};
    return second ? Place{node, halves[1], other, south, east} : Place{node, halves[0], other, north, west};
  }
  NodeId half_of(int x, int z, NodeId which) const {
    if (x < 0 || z < 0 || x >= lattice_.roots.x || z >= lattice_.roots.y) return 0;
    return root(2 * (static_cast<NodeId>(z) * lattice_.roots.x + x) + which);
  }

  const rtin::Lattice& lattice_;
};

}  // namespace terrabench::cbt
