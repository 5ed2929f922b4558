// Interval arithmetic over one batch of a column: proves that a step is wholly 0 or wholly 1 without
// evaluating its control. Float rounding is monotone, so that the rounded ends of an interval, computed by
// the machine's own operations, bound every rounded value inside. Tens of nanoseconds per batch.
#pragma once

#include <span>

#include "terrain/sources/noise/code.h"

namespace terrabench::noise {

struct Interval {
  float low = 0, high = 0;
};

// 0 or 1 when kStep(control, p) has that value everywhere, -1 when the bounds do not decide.
int decide_step(std::span<const IntervalStep> steps, const float* scratch, Interval y, float p);

}  // namespace terrabench::noise
