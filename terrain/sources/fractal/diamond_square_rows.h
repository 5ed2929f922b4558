// The inner loops of diamond-square, one row at a time, in the best instruction set of the machine. Every row
// is contiguous: a coarse row has `points` samples, a fine one 2·points − 1.
#pragma once

#include "terrain/sources/fractal/counter_random.h"

namespace terrabench::fractal {

struct RowDisplacement {
  RowKey key;
  float range;  // metres
};

// The middles of the squares between two coarse rows: middles[i] for i in [0, points − 1).
void diamond_row(const float* north, const float* south, int points, RowDisplacement, float* middles);

// A fine row through a coarse one: its points, and between them the square step from the middles above and
// below.
void even_row(const float* coarse, const float* middles_above, const float* middles_below, int points,
              RowDisplacement, float* fine);

// A fine row through middles: between them the square step. middles[-1] is the last of the row, since the
// array is circular.
void odd_row(const float* north, const float* south, const float* middles, int points, RowDisplacement,
             float* fine);

}  // namespace terrabench::fractal
