#include "representations/layered_stack/height_map.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "terrain/error.h"

namespace terrabench {
namespace {

// Levels of material under the top of the highest solid run, or only those that are solid.
int levels_of(const ColumnRuns& runs, ColumnHeight reading) {
  if (reading == ColumnHeight::kTop) return runs.highest();
  int sum = 0;
  runs.each_solid([&](int bottom, int top, Material) { sum += top - bottom; });
  return sum;
}

// Between which columns a sample lies, and its share of the second.
struct Between {
  int low, high;
  float share;
};
Between between(int sample, int finer, int columns) {
  const double at = std::clamp(static_cast<double>(sample) / finer - 0.5, 0.0, columns - 1.0);
  const int low = std::min(static_cast<int>(at), std::max(columns - 2, 0));
  return {low, std::min(low + 1, columns - 1), static_cast<float>(at - low)};
}

}  // namespace

Heightfield column_heights(const LayeredStack& stack, ColumnHeight reading) {
  const ColumnGrid& grid = stack.grid();
  Heightfield field = Heightfield::zeros(grid.width, grid.depth, static_cast<float>(grid.cell_x),
                                         static_cast<float>(grid.cell_z));
  tbb::parallel_for(0, grid.depth, [&](int j) {
    for (int i = 0; i < grid.width; ++i) field.at(i, j) = grid.edge_y(levels_of(stack.column(i, j), reading));
  });
  return field;
}

Heightfield height_map(const LayeredStack& stack, ColumnHeight reading, int finer) {
  if (finer < 1)
    throw usage_error("a height map needs at least one sample per column", "finer", "choose 1 or more");
  const Heightfield columns = column_heights(stack, reading);
  Heightfield map = Heightfield::zeros(columns.width * finer + 1, columns.depth * finer + 1,
                                       columns.cell_x / static_cast<float>(finer),
                                       columns.cell_z / static_cast<float>(finer));
  tbb::parallel_for(0, map.depth, [&](int j) {
    const Between z = between(j, finer, columns.depth);
    for (int i = 0; i < map.width; ++i) {
      const Between x = between(i, finer, columns.width);
      const float north = std::lerp(columns.at(x.low, z.low), columns.at(x.high, z.low), x.share);
      const float south = std::lerp(columns.at(x.low, z.high), columns.at(x.high, z.high), x.share);
      map.at(i, j) = std::lerp(north, south, z.share);
    }
  });
  return map;
}

}  // namespace terrabench
