// The boundary between solid and air of a grid of columns, as blocks.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "representations/column_grid.h"

namespace terrabench {

// The levels at which the solid parts of one row of columns begin and end, without materials.
class SurfaceRow {
 public:
  void clear() {
    levels_.clear();
    ends_.clear();
  }
  // Levels [bottom, top), in upward order; joins touching parts.
  void add_solid(int bottom, int top) {
    const std::size_t first = ends_.empty() ? 0 : ends_.back();
    if (levels_.size() > first && levels_.back() == bottom) {
      levels_.back() = static_cast<std::uint16_t>(top);
    } else {
      levels_.push_back(static_cast<std::uint16_t>(bottom));
      levels_.push_back(static_cast<std::uint16_t>(top));
    }
  }
  void end_column() { ends_.push_back(static_cast<std::uint32_t>(levels_.size())); }

  std::span<const std::uint16_t> column(std::size_t i) const {
    const std::uint32_t first = i == 0 ? 0 : ends_[i - 1];
    return {levels_.data() + first, ends_[i] - first};
  }

 private:
  std::vector<std::uint16_t> levels_;
  std::vector<std::uint32_t> ends_;
};

// Horizontal faces of one cell, vertical faces as tall as the exposed solid. Watertight and free of
// T-vertices: a wall has a vertex wherever one of the four columns around its edge begins or ends. Where
// solids touch along an edge only, a point in the middle of the edge is duplicated, so that each edge belongs
// to two triangles. `row_of(j, row)` fills all columns of row j; it must be thread-safe. A detail
// coarser than the grid takes every n-th column. O(boundary), parallel over rows, the same mesh for any
// number of threads. Throws usage_error for more than 2³² vertices.
TriangleMesh block_mesh(const ColumnGrid&, MeshDetail,
                        const std::function<void(int j, SurfaceRow& row)>& row_of);

}  // namespace terrabench
