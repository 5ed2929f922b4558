// The section of a carving at one place on its axis.
#pragma once

#include <vector>

#include "terrain/events/event.h"

namespace terrabench::events {

struct SectionRange {
  double low, high;  // metres
};

// The heights over the axis at which the vertical line `a` metres right of the axis lies inside the section
// at u, with the bulges of its walls: ascending. `out` is overwritten. O(sides).
void section_ranges(const Carving& carving, double u, double a, std::vector<SectionRange>& out);

// How far the section at u extends to the left (low) and right (high) of the axis, bulges included.
SectionRange section_reach(const Carving& carving, double u);

}  // namespace terrabench::events
