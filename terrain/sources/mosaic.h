// Large ground from a tile of measured heights.
#pragma once

#include "terrain/heightfield.h"

namespace terrabench {

// size × size samples: the tile in the middle, repeated to all sides, every second one mirrored, so that the
// ground is continuous. It has the tile's cells and no georeference: slopes and roughness are the tile's, but
// nothing larger than the tile was measured. size ≥ 1. O(size²).
Heightfield mirrored_mosaic(const Heightfield& tile, int size);

}  // namespace terrabench
