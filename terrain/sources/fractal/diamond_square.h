// Diamond-square (Fournier, Fussell & Carpenter 1982; Alonso et al., §2.3.1, figures 4 to 7) on an array that
// closes on itself: opposite borders are equal, and a diamond that straddles the border takes its fourth
// corner from the other side.
//
// Each displacement is a function of (seed, level, x, z) alone. A terrain with fewer levels is therefore the
// coarse part of one with more, and the result is the same for any number of threads and on any machine.
// O(side²) time; memory is the output and a quarter of it.
#pragma once

#include <cstdint>
#include <span>

#include "terrain/heightfield.h"

namespace terrabench::fractal {

struct DiamondSquareOptions {
  std::uint64_t seed = 1;
  int side = 513;          // samples, 2^n + 1 with n from 1 to 15
  float cell = 30;         // metres between samples
  float corner = 0;        // metres, height of the four corners
  float amplitude = 1000;  // metres, the most that a point of the first level is displaced
  float hurst = 0.8F;      // each level's range is 2^-hurst of the one before; 0 to 1, smoother upward
};

// Throws usage_error for options outside these ranges, environment_error when the field does not fit the
// memory.
Heightfield diamond_square(const DiamondSquareOptions&);

// The field after `steps` steps: 0 sets the corners, then diamond and square steps take turns. Points that no
// step has reached are no-data. steps lies in [0, 2n].
Heightfield diamond_square_after(const DiamondSquareOptions&, int steps);

// n of side = 2^n + 1. Throws usage_error for any other side.
int levels_of_side(int side);

// The same heights to the bit in bands of rows, for terrains larger than memory. Memory: a coarse grid, and
// per thread a band and its halo.
class DiamondSquareBands {
 public:
  // Keeps the grid of 2^kept + 1 samples per side; kept lies in [1, n]. Throws as diamond_square() does.
  // O(4^kept).
  explicit DiamondSquareBands(const DiamondSquareOptions&, int kept = 12);

  int side() const { return options_.side; }
  // Rows first … first + rows - 1 of the terrain, in [0, side], whole. Safe from many threads at once.
  // O(rows · side), and for each of n - kept levels about three rows more.
  void read(int first, int rows, std::span<float> out) const;

 private:
  // Of the grid of 2^level + 1 samples per side.
  void read_level(int level, int first, int rows, float* out) const;

  DiamondSquareOptions options_;
  int kept_;
  Heightfield coarse_;
};

}  // namespace terrabench::fractal
