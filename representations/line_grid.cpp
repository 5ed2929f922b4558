#include "representations/line_grid.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "representations/representation.h"

namespace terrabench {
LineGrid lines_of(const Heightfield& field) {
  return {field.width, field.depth, 0, 0, field.cell_x, field.cell_z, field.georeference};
}

LineGrid lines_of(const ColumnGrid& grid) {
  return {grid.width,
          grid.depth,
          grid.origin_x + 0.5 * grid.cell_x,
          grid.origin_z + 0.5 * grid.cell_z,
          grid.cell_x,
          grid.cell_z,
          {}};
}

LineGrid own_lines(const Representation& built) {
  LineGrid lines = built.lines();
  if (lines.origin_x != 0 || lines.origin_z != 0) {
    lines.georeference.transform = {lines.origin_x - 0.5 * lines.cell_x,
                                    lines.cell_x,
                                    0,
                                    0.5 * lines.cell_z - lines.origin_z,
                                    0,
                                    -lines.cell_z};
  }
  return lines;
}

Georeference place(const LineGrid& lines, const LineGrid& placed) {
  Georeference georeference = placed.georeference;
  std::array<double, 6>& t = georeference.transform;
  if (t == std::array<double, 6>{}) return {};
  const double ratio_x = lines.cell_x / placed.cell_x, ratio_z = lines.cell_z / placed.cell_z;
  // The corner of the first pixel, in pixels of `placed`; exactly 0 for equal lines.
  const double u = (lines.origin_x - placed.origin_x) / placed.cell_x + 0.5 * (1 - ratio_x),
               v = (lines.origin_z - placed.origin_z) / placed.cell_z + 0.5 * (1 - ratio_z);
  t[0] += u * t[1] + v * t[2];
  t[3] += u * t[4] + v * t[5];
  for (const std::size_t k : {1U, 4U}) t[k] *= ratio_x;
  for (const std::size_t k : {2U, 5U}) t[k] *= ratio_z;
  return georeference;
}

ColumnGrid columns_around(const LineGrid& lines, const Bounds& bounds) {
  ColumnGrid grid;
  grid.width = lines.width;
  grid.depth = lines.depth;
  grid.cell_x = lines.cell_x;
  grid.cell_z = lines.cell_z;
  grid.origin_x = lines.origin_x - 0.5 * lines.cell_x;
  grid.origin_z = lines.origin_z - 0.5 * lines.cell_z;
  grid.origin_y = bounds.low.y;
  const double height = std::max(static_cast<double>(bounds.size().y), 1e-6);
  grid.step = std::max(std::min(lines.cell_x, lines.cell_z), height / ColumnGrid::kMaxLevels);
  grid.levels = std::clamp(static_cast<int>(std::ceil(height / grid.step)), 1, ColumnGrid::kMaxLevels);
  return grid;
}

void topmost(const SpanSink& columns, std::span<float> heights) {
  for (std::size_t c = 0; c < columns.columns(); ++c) {
    const std::span<const Span> column = columns.column(c);
    heights[c] = column.empty() ? Heightfield::kNoData : column.back().top;
  }
}

void topmost(const Representation& built, const LineGrid& lines, int first, std::span<float> heights) {
  const auto width = static_cast<std::size_t>(lines.width);
  std::vector<float> x(width);
  for (std::size_t i = 0; i < width; ++i) x[i] = lines.x(static_cast<int>(i));
  tbb::parallel_for(std::size_t{0}, heights.size() / width, [&](std::size_t row) {
    const std::vector<float> z(width, lines.z(first + static_cast<int>(row)));
    SpanSink sink;
    built.spans({x, z}, sink);
    topmost(sink, heights.subspan(row * width, width));
  });
}

}  // namespace terrabench
