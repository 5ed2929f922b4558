// Local minima: what drills should not leave behind (Stuetzle & Franklin 2012, §1 and §4).
//
// Shapes that never fall outward, with elevations that never rise downstream
// (DrillOptions::monotone_profiles), leave none. From any drilled pixel a step towards the centre of the
// drill that dug deepest there is no step up; a centre that another drill dug deeper hands over to that one,
// which happens only downward; any other centre has the next one downstream beside it, not higher, and so on
// until the outlet. Rounding keeps all of these relations (see regenerate.cpp and drill_codec.h).
// Interpolated pixels are not covered.
#pragma once

#include <cstddef>

#include "terrain/heightfield.h"

namespace terrabench {

struct Pits {
  std::size_t count = 0;   // flats (single pixels included) from which no neighbour of 8 leads down or out
  std::size_t pixels = 0;  // that they cover
};

// Water leaves over the grid's edge and into pixels without data. O(pixels).
Pits count_pits(const Heightfield& field);

}  // namespace terrabench
