// Diamond-square (Fournier, Fussell & Carpenter 1982; Alonso et al., §2.3.1, figures 4 to 7) on an array that
// closes on itself: opposite borders are equal, and a diamond that straddles the border takes its fourth
// corner from the other side.
//
// Each displacement is a function of (seed, level, x, z) alone. A terrain with fewer levels is therefore the
// coarse part of one with more, and the result is the same for any number of threads and on any machine.
// O(side²) time; memory is the output and a few rows per thread.
#pragma once

#include <cstdint>

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

}  // namespace terrabench::fractal
