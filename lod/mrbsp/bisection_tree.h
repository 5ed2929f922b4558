// The tree of the MRBSP paper (§2) without a node in memory: a square, cut along a diagonal into two
// right-angled triangles, each of which is cut from its right angle to the middle of its hypotenuse, and so
// on. Depth d holds 2^d triangles; they cover the square. A node's number says where it lies.
//
// Lattice: the square has side 2^k, and vertices have whole coordinates (i, j) in [0, 2^k]². At odd depth
// 2m + 1 the triangles are the halves of 2^m × 2^m squares, legs along the axes, and their corners are a full
// grid of (2^m + 1)² vertices. At even depth 2m each of 2^(m-1) × 2^(m-1) squares is cut by both diagonals,
// hypotenuses along the axes, and the corners are every second vertex of a (2^m + 1)² grid (i + j even). So
// the paper's 65,536 triangles (depth 16) stand on 33,025 of the 257² grid points: 128² squares of four
// triangles. Depth 17 takes all of 257². The deepest that a lattice carries is 2k + 1.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <glm/vec2.hpp>
#include <string>
#include <string_view>

namespace terrabench {

// Corners in the lattice, counter-clockwise from above: the right angle first.
struct PlanTriangle {
  glm::ivec2 apex, left, right;
  bool operator==(const PlanTriangle&) const = default;
};

// 1 is the square; the children of node n are 2n and 2n + 1. At depth d: 2^d ≤ n < 2^(d+1).
using NodeNumber = std::uint64_t;

class BisectionTree {
 public:
  static constexpr int kDeepest = 31;  // so that numbers fit 32 bits

  // Throws usage_error unless 0 ≤ side_bits ≤ 15 and 1 ≤ depth ≤ 2·side_bits + 1.
  BisectionTree(int side_bits, int depth);
  // The smallest square over so many samples; depth 0 takes the deepest. Throws usage_error when that is
  // beyond kDeepest or the depth too deep.
  static BisectionTree over(int width, int samples_deep, int depth = 0);

  int side_bits() const { return side_bits_; }
  int side() const { return 1 << side_bits_; }
  int depth() const { return depth_; }
  std::uint64_t triangles() const { return std::uint64_t{1} << depth_; }
  // How many different corners the triangles of the greatest depth have.
  std::uint64_t vertices() const;
  // Between neighbouring vertices along a grid line, over all lines.
  int spacing() const { return side() >> (depth_ / 2); }
  // Side of the squares whose borders are edges of triangles at that depth: full lines of edges run there.
  int square_at(int depth) const { return side() >> ((depth - 1) / 2); }
  // Is it a corner of a triangle at the greatest depth?
  bool has_vertex(glm::ivec2 at) const;

  // The two halves of the square.
  std::array<PlanTriangle, 2> roots() const;
  // O(1), and O(depth) from a number.
  static PlanTriangle child(const PlanTriangle& t, unsigned which) {
    const glm::ivec2 middle = (t.left + t.right) / 2;
    return which == 0 ? PlanTriangle{middle, t.apex, t.left} : PlanTriangle{middle, t.right, t.apex};
  }
  PlanTriangle triangle(NodeNumber node) const;

  // Depth of the triangles (two, or one at the border) that a vertex cuts in half: those whose hypotenuse it
  // halves. 0 for the corners of the square, which cut nothing. O(1).
  int split_depth(glm::ivec2 vertex) const;
  // The one or two vertices that must be there before this one can cut without leaving a hole: the right
  // angles of the triangles that it cuts. None for the first cut's. O(1).
  struct Parents {
    std::array<glm::ivec2, 2> at;
    int count = 0;
  };
  Parents parents(glm::ivec2 vertex) const {
    Parents parents;
    const int bits = vertex.x | vertex.y, step = bits & -bits;
    if (step == 0 || step * 2 > side()) return parents;
    const bool odd_x = (vertex.x & step) != 0, odd_y = (vertex.y & step) != 0;
    if (odd_x && odd_y) {
      // The middle of a square of side 2·step: its right angles stand where the coordinates, in such sides,
      // add up to an odd number.
      if (step * 2 == side()) return parents;
      const bool rising = (((vertex.x - step) + (vertex.y - step)) & (2 * step)) != 0;
      const glm::ivec2 towards(step, rising ? step : -step);
      parents = {{vertex - towards, vertex + towards}, 2};
      return parents;
    }
    const glm::ivec2 towards = odd_x ? glm::ivec2(0, step) : glm::ivec2(step, 0);
    for (const glm::ivec2 at : {vertex - towards, vertex + towards}) {
      if (std::min(at.x, at.y) >= 0 && std::max(at.x, at.y) <= side()) parents.at[parents.count++] = at;
    }
    return parents;
  }

 private:
  int side_bits_, depth_;
};

inline int depth_of(NodeNumber node) { return std::bit_width(node) - 1; }
// The paper's hierarchical number: a digit a level below the square, "" for the square itself.
std::string label(NodeNumber node);
// Throws nothing: false for anything but 1 to kDeepest digits 0 and 1.
bool parse_label(std::string_view text, NodeNumber& node);

}  // namespace terrabench
