// The section of a carving at one place on its axis.
#pragma once

#include <vector>

#include "terrain/events/event.h"

namespace terrabench::events {

struct Run {
  double low, high;  // heights over the axis, metres
};

// Where the upright line at `a` metres right of the axis, u along it, lies within the section, walls with
// their bulges: ascending. `out` is overwritten. O(sides).
void section_runs(const Carving& carving, double u, double a, std::vector<Run>& out);

// How far the section reaches right of the axis at u: from low to high, bulges included.
Run section_reach(const Carving& carving, double u);

}  // namespace terrabench::events
