// The tree of the MRBSP paper (§2), implicit: no node is stored, a node's number determines its triangle. A
// square is split along a diagonal into two right-angled triangles; each is split along the line from its
// right angle to the centre of its hypotenuse, and so on. The 2^d triangles at depth d cover the square.
//
// Vertices have integer coordinates (i, j) in [0, 2^k]², where 2^k is the side of the square.
// - Odd depth 2m + 1: the triangles are the halves of 2^m × 2^m squares, legs along the axes; their corners
//   are all points of a grid of (2^m + 1)².
// - Even depth 2m: each of 2^(m-1) × 2^(m-1) squares is split by both diagonals, hypotenuses along the axes;
//   the corners are every second point (i + j even) of a grid of (2^m + 1)².
// So the paper's 65,536 triangles (depth 16) use 33,025 of 257² grid points: 128² squares of four triangles.
// Depth 17 uses all 257². The greatest depth is 2k + 1.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <glm/vec2.hpp>
#include <string>
#include <string_view>

#include "terrain/frame.h"

namespace terrabench {

// Corners counter-clockwise from above, the right angle first.
struct PlanTriangle {
  glm::ivec2 apex, left, right;
  bool operator==(const PlanTriangle&) const = default;
};

// 1 is the square; the children of node n are 2n and 2n + 1. At depth d: 2^d ≤ n < 2^(d+1).
using NodeNumber = std::uint64_t;
inline NodeNumber first_node(int depth) { return NodeNumber{1} << depth; }
inline int depth_of(NodeNumber node) { return std::bit_width(node) - 1; }

class BisectionTree {
 public:
  static constexpr int kDeepest = 31;  // so that node numbers fit 32 bits

  // Throws usage_error unless 0 ≤ side_bits ≤ 15 and 1 ≤ depth ≤ 2·side_bits + 1.
  BisectionTree(int side_bits, int depth);
  // Over the smallest square that covers width × samples_deep samples; depth 0: the greatest depth. Throws
  // usage_error for a square or a depth that is too large.
  static BisectionTree over(int width, int samples_deep, int depth = 0);

  int side_bits() const { return side_bits_; }
  int side() const { return 1 << side_bits_; }
  int depth() const { return depth_; }
  // At the greatest depth: the number of triangles, and of their distinct corners.
  std::uint64_t triangles() const { return std::uint64_t{1} << depth_; }
  std::uint64_t vertices() const;
  // Distance between neighbouring grid lines that vertices lie on.
  int spacing() const { return side() >> (depth_ / 2); }
  // Side of the squares whose borders consist of edges of triangles at that depth.
  int square_at(int depth) const { return side() >> ((depth - 1) / 2); }

  // The two halves of the square.
  std::array<PlanTriangle, 2> roots() const;
  static PlanTriangle child(const PlanTriangle& t, unsigned which) {  // O(1)
    const glm::ivec2 centre = (t.left + t.right) / 2;
    return which == 0 ? PlanTriangle{centre, t.apex, t.left} : PlanTriangle{centre, t.right, t.apex};
  }
  PlanTriangle triangle(NodeNumber node) const;  // O(depth)

  // A vertex splits the triangles (two, or one at the border) whose hypotenuse it is the centre of. Returns
  // the vertices (one or two) that must split before this one may, or a hole opens: the right angles of those
  // triangles. None for the centre and the corners of the square. O(1).
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
      // The centre of a square of side 2·step. The right angles are at the corners whose coordinates, in
      // units of that side, have an odd sum.
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

// The paper's hierarchical number: one digit per level below the square, "" for the square itself.
std::string label(NodeNumber node);
// False for anything but 1 to kDeepest digits 0 or 1.
bool parse_label(std::string_view text, NodeNumber& node);

// Bilinear interpolation of the four samples around (x, z), which are in samples and inside the field. O(1).
float sample_height(const GroundGrid&, float x, float z);

// Height of the tree's finest triangles at (x, z) in metres, clamped to the field. The triangles do not use
// all samples at even depths, so an eye placed by the samples alone may be below them. In a triangle that
// extends beyond the field, the height of its highest corner. O(depth).
float surface_height(const BisectionTree&, const GroundGrid&, float x, float z);

}  // namespace terrabench
