// Conservative visibility (MRBSP paper, §4, "area-to-area"): the sets contain every triangle that an eye in
// the cell can see, over the full surface, for every eye on the surface or up to the eye height above it. An
// eye below the surface is not covered: terrain does not block its lines of sight (Mrbsp::on_the_ground()).
//
// Cells and blocks of ground are nodes of one quadtree. A block is hidden from a cell if, on some grid line
// between the two, the lowest ground along the stretch that their lines of sight cross lies above the highest
// of these lines. Where the test fails, block and cell are split into quarters. Only the highest eye in the
// cell and the highest ground in the block count: a lower eye sees no more, lower ground is seen no better.
//
// In detail, for a cell K and a block T that are disjoint in x (z alike), and a grid line x = u between them:
// a line of sight from e in K to p in T crosses x = u at the fraction s = (u - e.x) / (p.x - e.x). This lies
// between s0 (e at the near side of K, p at the far side of T) and s1 (e at the far side, p at the near one).
// The crossing's z lies between (1 - s)·K.z + s·T.z for these two s. Its height is at most H + s·(t - H) for
// an eye at height H and a block with its top at t. Grid lines are edges of the finest triangles, so the
// lowest vertex over that stretch of z bounds the ground from below.
#pragma once

#include <array>
#include <vector>

#include "lod/mrbsp/visibility/coarse_squares.h"
#include "lod/mrbsp/visibility/sets.h"
#include "terrain/frame.h"

namespace terrabench::mrbsp::visibility {

class AreaOcclusion {
 public:
  // The ground must outlive it.
  AreaOcclusion(const GroundGrid&, const BisectionTree&, const CellGrid&, float eye_height);
  // Adds the triangles that can be seen from the cell.
  void find(const CoarseSquares&, int cell, Sets&) const;

 private:
  // A square of 2^level × 2^level finest blocks.
  struct Block {
    int level, x, z;
    Block child(int which) const { return {level - 1, 2 * x + (which & 1), 2 * z + (which >> 1)}; }
  };
  struct Interval {
    float low, high;
  };
  // Lowest ground along the grid lines of one direction. A stretch is one block side along a line; lowest[k]
  // holds the minimum over 2^k stretches from each stretch on.
  struct GridLines {
    int count = 0, stretches = 0;
    std::vector<std::vector<float>> lowest;        // [k][line · stretches + first]
    float over(int line, int from, int to) const;  // stretches, both included
  };

  int blocks_along(int axis, int level) const;
  float top(const Block&) const;
  Interval span(const Block&, int axis) const;  // samples
  bool hidden(const Block& cell, float eye, const Block& block) const;
  bool hidden_across(int axis, Interval k, Interval t, Interval k_side, Interval t_side, float eye,
                     float top) const;
  bool seen_from_part(const Block& cell, const Block& block) const;
  void find(const CoarseSquares&, const Block& cell, float eye, const Block& block, int index, Sets&) const;
  void make_lines(int axis);
  void make_tops();

  const GroundGrid& ground_;
  int side_;  // samples along the side of a finest block
  float eye_height_;
  int cell_level_ = 0;
  std::vector<std::vector<float>> tops_;  // highest ground, by level
  std::array<GridLines, 2> lines_;        // across x, across z
};

}  // namespace terrabench::mrbsp::visibility
