// Connected components of a stacked terrain: the measure for the claims of "hybrid" §3.1.3 that attenuation
// prevents floating islands, and that moving samples sideways makes overhangs.
#pragma once

#include <cstddef>

#include "representations/layered_stack/layered_stack.h"

namespace terrabench {

struct Components {
  std::size_t total = 0;             // connected solids, joined through faces of cells
  std::size_t floating = 0;          // those without a cell on the lowest level
  double solid_volume = 0;           // m³
  double floating_volume = 0;        // m³
  std::size_t overhang_columns = 0;  // columns with air under solid
  std::size_t solid_columns = 0;     // columns with any solid
};

// Union-find over solid stretches of neighbouring columns; all materials but air are solid. O(runs·α), 4 B
// per stretch. Throws usage_error for more than 2³² stretches.
Components find_components(const LayeredStack&);

}  // namespace terrabench
