#include "terrain/source.h"

#include <algorithm>
#include <utility>

namespace terrabench {

Bounds TerrainSource::bounds() const {
  if (solid) return solid->bounds;
  const HeightRange range = height_range(*heights);
  const float floor = range.lowest - std::max(heights->cell_x, heights->cell_z);
  return {{0, floor, 0}, {heights->extent_x(), range.highest, heights->extent_z()}};
}

TerrainSource source_of(std::string_view name, Heightfield heights) {
  TerrainSource source;
  source.name = name;
  source.checksum = checksum(heights);
  source.heights = std::move(heights);
  return source;
}

}  // namespace terrabench
