// Which triangle of a triangulation holds a point: a coarse grid of triangles to start from, then a walk.
#pragma once

#include <cmath>
#include <span>
#include <vector>

#include "representations/tin/delaunay.h"

namespace terrabench::tin {

class Locator {
 public:
  Locator() = default;
  // The samples are those of the rectangle that is triangulated. O(triangles).
  Locator(const Delaunay&, int width, int depth);

  // After a change: the triangles with other corners or another index, in use. O(their cells), but in the
  // mean over many changes O(triangles) when their number has doubled or halved.
  void update(const Delaunay&, std::span<const std::uint32_t> changed, int width, int depth);

  // The triangle that holds the point, on its border at least; `i` and `j` in cells, inside the rectangle and
  // multiples of 2⁻²⁰, so that doubles are exact.
  std::uint32_t find(const Delaunay&, double i, double j) const;
  Memory memory() const { return index_memory(start_); }

 private:
  static constexpr double kTrianglesPerCell = 2;

  // The sample at the middle of a cell.
  double middle_i(int column) const { return std::floor((column + 0.5) / per_i_); }
  double middle_j(int row) const { return std::floor((row + 0.5) / per_j_); }

  std::size_t triangles_ = 0;  // when it was made
  int columns_ = 1, rows_ = 1;
  double per_i_ = 1, per_j_ = 1;      // cells of this grid per sample
  std::vector<std::uint32_t> start_;  // the triangle at each cell's middle
};

// Twice the area of (a, b, (i, j)).
inline double twice_area_to(Sample a, Sample b, double i, double j) {
  return (b.i - a.i) * (j - a.j) - (b.j - a.j) * (i - a.i);
}

}  // namespace terrabench::tin
