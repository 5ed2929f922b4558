// Local minima, which drills should not leave (Stuetzle & Franklin 2012, §1 and §4).
//
// Shapes that never fall outward, with elevations that never rise downstream
// (DrillOptions::monotone_profiles), leave none: from any drilled pixel a path leads to an outlet and
// never rises. Towards the centre of the drill that cut deepest at the pixel, the terrain does not rise. If
// another drill cut deeper at that centre, the path continues towards that drill's centre, which is lower;
// otherwise to the centre downstream, which is not higher. Rounding keeps all of these relations (see
// regenerate.cpp and quantum.h). Interpolated pixels are not covered.
#pragma once

#include <cstddef>

#include "terrain/heightfield.h"

namespace terrabench {

// The number of flats (single pixels included) of which no pixel has a lower neighbour or drains out. Water
// leaves over the grid's edge and into pixels without data. O(pixels).
std::size_t count_pits(const Heightfield& field);

}  // namespace terrabench
