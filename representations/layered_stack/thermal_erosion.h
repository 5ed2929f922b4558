// Thermal erosion of material stacks, which the hybrid paper leaves to future work (its last section): the
// rule of Musgrave, Kolb and Mace (1989) for heights, here for every open surface of a column, those in caves
// too.
//
// The top of a solid run slides towards a neighbour (eight around each column) whose cell beside the topmost
// one is air, and falls onto the highest solid below, or onto the terrain's floor, where they differ by more
// than the talus angle allows. What slides first lands first, so a moved stretch of layers is turned over.
// Runs lose and gain at their tops alone, so a gap never closes from above. Rock whose sides slide away stays
// where it is: the stacks know no forces, and a roof without pillars is taken off at its edges anyway.
// Nothing leaves the terrain at its borders; a column without solid lets material fall to the floor.
//
// The allowance is a whole number of levels and at least one, as two columns cannot swap less: angles below
// one level per column act as that. Every move lowers the potential energy, so erosion ends by itself.
#pragma once

#include <cstdint>

#include "representations/layered_stack/layered_stack.h"

namespace terrabench {

struct ThermalErosionOptions {
  double talus = 35;    // degrees, 0 ≤ talus < 90
  double share = 1;     // of what would level a pair of columns to the talus angle, per step; 0 < share ≤ 1
  int steps = 100'000;  // at most; each visits every pair of neighbours once
};

struct ThermalErosion {
  int steps = 0;            // with movement
  std::int64_t moved = 0;   // levels times columns, counted at each move
  std::size_t columns = 0;  // that differ afterwards
  bool settled = false;     // no slope between open neighbours is steeper than the talus angle
};

// Erodes `stack` and writes the columns that changed through `edited`, which is the stack or the surface that
// holds it, so that its versions grow. The count of solid cells, per material too, stays as it was. Pairs are
// visited in a fixed order, no column in two pairs at a time: the same result for any number of threads.
// Throws usage_error for options out of range, and interrupted; then nothing has changed. O(runs) per step,
// and rows that came to rest are skipped.
ThermalErosion erode_thermally(const LayeredStack& stack, Representation& edited,
                               const ThermalErosionOptions&, Progress&);

}  // namespace terrabench
