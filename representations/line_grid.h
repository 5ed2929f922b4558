// The vertical lines along which a representation is written to rasters and tables, and the lattice on which
// it is written as voxels.
#pragma once

#include <span>

#include "representations/column_grid.h"
#include "terrain/heightfield.h"

namespace terrabench {

class Representation;
class SpanSink;

// Line (i, j) stands at (origin_x + i·cell_x, origin_z + j·cell_z) metres.
struct LineGrid {
  int width = 1, depth = 1;           // lines along x and z
  double origin_x = 0, origin_z = 0;  // of line (0, 0)
  double cell_x = 1, cell_z = 1;      // between neighbouring lines
  Georeference georeference;          // of a raster with a pixel around each line

  float x(int i) const { return static_cast<float>(origin_x + i * cell_x); }
  float z(int j) const { return static_cast<float>(origin_z + j * cell_z); }
};

// A line per sample.
LineGrid lines_of(const Heightfield&);
// A line through the middle of each column.
LineGrid lines_of(const ColumnGrid&);
// Representation::lines() with a place: without a georeference, except that ground which begins elsewhere
// than at (0, 0) is placed there, in metres to the east and to the north.
LineGrid own_lines(const Representation&);

// The georeference of `lines`, which stand on the same ground as `placed`. Exactly that of `placed` for equal
// lines; empty if it has none.
Georeference place(const LineGrid& lines, const LineGrid& placed);

// A column around each line, cut into levels of the lesser distance between lines, or thicker ones
// if there were more than ColumnGrid::kMaxLevels.
ColumnGrid columns_around(const LineGrid&, const Bounds&);

// The upper ends of `columns`; no-data where a column is empty. O(columns)
void topmost(const SpanSink& columns, std::span<float> heights);
// Of whole rows of lines, from `first` on; as many as fill `heights`. Parallel over rows.
void topmost(const Representation&, const LineGrid&, int first, std::span<float> heights);

}  // namespace terrabench
