#include "terrain/source.h"

#include <algorithm>

namespace terrabench {

Bounds TerrainSource::bounds() const {
  if (solid) return solid->bounds;
  const HeightRange range = height_range(*heights);
  const float floor = range.lowest - std::max(heights->cell_x, heights->cell_z);
  return {{0, floor, 0}, {heights->extent_x(), range.highest, heights->extent_z()}};
}

}  // namespace terrabench
