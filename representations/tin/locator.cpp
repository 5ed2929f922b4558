#include "representations/tin/locator.h"

#include <algorithm>
#include <cmath>

namespace terrabench::tin {
namespace {

// From one triangle to the next across an edge that has the point on its other side.
std::uint32_t walk(const Delaunay& surface, std::uint32_t at, double i, double j) {
  for (;;) {
    const Triangle& t = surface.triangles()[at];
    const Sample a = surface.vertex(t, 0), b = surface.vertex(t, 1), c = surface.vertex(t, 2);
    std::size_t beyond = 3;
    if (twice_area_to(b, c, i, j) < 0) {
      beyond = 0;
    } else if (twice_area_to(c, a, i, j) < 0) {
      beyond = 1;
    } else if (twice_area_to(a, b, i, j) < 0) {
      beyond = 2;
    }
    if (beyond == 3) return at;
    at = t.neighbour[beyond];
  }
}

}  // namespace

Locator::Locator(const Delaunay& surface, int width, int depth) : triangles_(surface.triangles().size()) {
  const double cells = std::max(1.0, static_cast<double>(surface.triangles().size()) / kTrianglesPerCell);
  const double side = std::sqrt(static_cast<double>(width - 1) * (depth - 1) / cells);
  columns_ = std::max(1, static_cast<int>((width - 1) / side));
  rows_ = std::max(1, static_cast<int>((depth - 1) / side));
  per_i_ = columns_ / static_cast<double>(width - 1);
  per_j_ = rows_ / static_cast<double>(depth - 1);
  start_.resize(static_cast<std::size_t>(columns_) * rows_);
  std::uint32_t near = 0;
  for (int row = 0; row < rows_; ++row) {
    // To and fro, so that each walk begins beside its end.
    for (int k = 0; k < columns_; ++k) {
      const int column = row % 2 == 0 ? k : columns_ - 1 - k;
      near = walk(surface, near, middle_i(column), middle_j(row));
      start_[static_cast<std::size_t>(row) * columns_ + column] = near;
    }
  }
}

void Locator::update(const Delaunay& surface, std::span<const std::uint32_t> changed, int width, int depth) {
  const std::size_t now = surface.triangles().size();
  if (now > 2 * triangles_ || now < triangles_ / 2) {
    *this = Locator(surface, width, depth);
    return;
  }
  for (const std::uint32_t t : changed) {
    const auto [a, b, c] = surface.corners(surface.triangles()[t]);
    const auto [west, east] = std::minmax({a.i, b.i, c.i});
    const auto [north, south] = std::minmax({a.j, b.j, c.j});
    const int last_column = std::min(columns_ - 1, static_cast<int>((east + 1) * per_i_));
    const int last_row = std::min(rows_ - 1, static_cast<int>((south + 1) * per_j_));
    for (int row = std::max(0, static_cast<int>(north * per_j_) - 1); row <= last_row; ++row) {
      for (int column = std::max(0, static_cast<int>(west * per_i_) - 1); column <= last_column; ++column) {
        const double i = middle_i(column), j = middle_j(row);
        if (twice_area_to(a, b, i, j) >= 0 && twice_area_to(b, c, i, j) >= 0 &&
            twice_area_to(c, a, i, j) >= 0) {
          start_[static_cast<std::size_t>(row) * columns_ + column] = t;
        }
      }
    }
  }
}

std::uint32_t Locator::find(const Delaunay& surface, double i, double j) const {
  const int column = std::min(columns_ - 1, static_cast<int>(i * per_i_));
  const int row = std::min(rows_ - 1, static_cast<int>(j * per_j_));
  return walk(surface, start_[static_cast<std::size_t>(row) * columns_ + column], i, j);
}

}  // namespace terrabench::tin
