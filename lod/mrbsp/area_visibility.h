// Visibility from everywhere in a cell at once, which never misses: see visibility.h. Cells and blocks of
// ground are nodes of one quadtree.
//
// Between a cell K and a block T apart in x, say, stands the grid line x = u. A line of sight from e in K to
// p in T crosses it after the share s = (u - e.x) / (p.x - e.x) of its way, between s0 (e at K's near side, p
// at T's far side) and s1 (the other way round); at a z between (1 - s)·K.z + s·T.z for these two s, and no
// higher than H + s·(t - H) for the eye's height H and the block's top t. The ground along grid lines is the
// finest triangles' edges, so its lowest vertex over that stretch of z bounds it from below. Where that is
// higher, no line of sight passes.
#pragma once

#include <array>
#include <vector>

#include "lod/mrbsp/coarse_squares.h"
#include "lod/mrbsp/visibility.h"
#include "terrain/frame.h"

namespace terrabench {

class AreaVisibility {
 public:
  AreaVisibility(const GroundGrid&, const BisectionTree&, const CellGrid&, float eye_height);
  // Adds what can be seen from the cell.
  void find(const CoarseSquares&, int cell, VisibleSets&) const;

 private:
  // Blocks of 2^level finest blocks a side; 0 is the finest.
  struct Block {
    int level, x, z;
    Block child(int which) const { return {level - 1, 2 * x + (which & 1), 2 * z + (which >> 1)}; }
  };
  struct Interval {
    float low, high;
  };
  // Lowest ground along grid lines of one direction: ranges of 2^k stretches of one block side.
  struct Lines {
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
  void find(const CoarseSquares&, const Block& cell, float eye, const Block& block, int index,
            VisibleSets&) const;
  void make_lines(int axis);
  void make_tops();

  const GroundGrid& ground_;
  int side_;  // samples a finest block
  float eye_height_;
  int cell_level_ = 0;
  std::vector<std::vector<float>> tops_;  // highest ground, by level
  std::array<Lines, 2> lines_;            // across x, across z
};

}  // namespace terrabench
