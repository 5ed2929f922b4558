// Diamond-square (diamond_square.h) in bands of rows, for terrains larger than memory: the same heights to
// the bit, at any row. Memory: a coarse grid, and per thread a band and its halo.
#pragma once

#include <span>

#include "terrain/sources/fractal/diamond_square.h"

namespace terrabench::fractal {

class DiamondSquareBands {
 public:
  // Keeps the grid of 2^kept + 1 samples per side; kept lies in [1, n]. Throws as diamond_square() does.
  // O(4^kept).
  DiamondSquareBands(const DiamondSquareOptions&, int kept = 12);

  int side() const { return options_.side; }
  // Rows first … first + rows - 1 of the terrain, in [0, side], whole. Safe from many threads at once.
  // O(rows · side), and for each of n - kept levels about three rows more.
  void read(int first, int rows, std::span<float> out) const;

 private:
  void expand(int level, int first, int rows, float* out) const;

  DiamondSquareOptions options_;
  int kept_, levels_;
  Heightfield coarse_;
};

}  // namespace terrabench::fractal
