// Which triangle of a triangulation holds a point: a coarse grid of triangles to start from, then a walk.
#pragma once

#include <cmath>
#include <span>
#include <vector>

#include "terrain/tin/delaunay.h"

namespace terrabench::tin {

class Locator {
 public:
  Locator() = default;
  // The samples are those of the rectangle that is triangulated. O(triangles).
  Locator(const Delaunay&, int width, int depth);

  // After a change: the triangles with other corners or another index, in use. O(their cells), but in the
  // mean over many changes O(triangles) when their number has doubled or halved.
  void update(const Delaunay&, std::span<const std::uint32_t> changed, int width, int depth);

  // In cells, inside the rectangle and multiples of 2⁻²⁰, so that doubles are exact.
  struct Point {
    double i, j;
  };
  // The triangle that holds the point, on its border at least.
  std::uint32_t find(const Delaunay&, Point) const;
  std::uint32_t find(const Delaunay& surface, Sample s) const {
    return find(surface, Point{static_cast<double>(s.i), static_cast<double>(s.j)});
  }
  // The same for up to kAtOnce points side by side: while one waits for memory, the others go on.
  void find(const Delaunay&, std::span<const Point>, std::span<std::uint32_t> triangles) const;
  static constexpr std::size_t kAtOnce = 64;
  Memory memory() const { return index_memory(start_); }

 private:
  static constexpr double kTrianglesPerCell = 2;

  const std::uint32_t& start(Point) const;
  // The sample at the middle of a cell.
  double middle_i(int column) const { return std::floor((column + 0.5) / per_i_); }
  double middle_j(int row) const { return std::floor((row + 0.5) / per_j_); }

  std::size_t triangles_ = 0;  // when it was made
  int columns_ = 1, rows_ = 1;
  double per_i_ = 1, per_j_ = 1;      // cells of this grid per sample
  std::vector<std::uint32_t> start_;  // the triangle at each cell's middle
};

// Twice the area of (a, b, p).
inline double twice_area_to(Sample a, Sample b, Locator::Point p) {
  return (b.i - a.i) * (p.j - a.j) - (b.j - a.j) * (p.i - a.i);
}

}  // namespace terrabench::tin
