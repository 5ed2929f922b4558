#include "terrain/heightfield.h"

#include <fmt/format.h>

#include <algorithm>

#include "terrain/error.h"
#include "terrain/files.h"

namespace terrabench {

float Heightfield::sample(float x, float z) const {
  const float u = x / cell_x, v = z / cell_z;
  if (!(u >= 0 && v >= 0 && u <= static_cast<float>(width - 1) && v <= static_cast<float>(depth - 1)))
    return kNoData;
  const int i = std::min(static_cast<int>(u), std::max(width - 2, 0));
  const int j = std::min(static_cast<int>(v), std::max(depth - 2, 0));
  const int i1 = std::min(i + 1, width - 1), j1 = std::min(j + 1, depth - 1);
  const float s = u - static_cast<float>(i), t = v - static_cast<float>(j);
  const float north = at(i, j) + s * (at(i1, j) - at(i, j));
  const float south = at(i, j1) + s * (at(i1, j1) - at(i, j1));
  return north + t * (south - north);
}

HeightRange height_range(const Heightfield& field) {
  HeightRange range{std::numeric_limits<float>::infinity(), -std::numeric_limits<float>::infinity(), 0};
  for (const float height : field.heights) {
    if (Heightfield::is_no_data(height)) {
      ++range.no_data;
    } else {
      range.lowest = std::min(range.lowest, height);
      range.highest = std::max(range.highest, height);
    }
  }
  return range;
}

}  // namespace terrabench
