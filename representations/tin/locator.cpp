#include "representations/tin/locator.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace terrabench::tin {
namespace {

// The neighbour across an edge that has the point on its other side; the triangle itself if it has none.
std::uint32_t step(const Delaunay& surface, std::uint32_t at, Locator::Point p) {
  const Triangle& t = surface.triangles()[at];
  const auto [a, b, c] = surface.corners(t);
  if (twice_area_to(b, c, p) < 0) return t.neighbour[0];
  if (twice_area_to(c, a, p) < 0) return t.neighbour[1];
  if (twice_area_to(a, b, p) < 0) return t.neighbour[2];
  return at;
}

std::uint32_t walk(const Delaunay& surface, std::uint32_t at, Locator::Point p) {
  for (;;) {
    const std::uint32_t next = step(surface, at, p);
    if (next == at) return at;
    at = next;
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
      near = walk(surface, near, {middle_i(column), middle_j(row)});
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
        const Point middle{middle_i(column), middle_j(row)};
        if (twice_area_to(a, b, middle) >= 0 && twice_area_to(b, c, middle) >= 0 &&
            twice_area_to(c, a, middle) >= 0) {
          start_[static_cast<std::size_t>(row) * columns_ + column] = t;
        }
      }
    }
  }
}

const std::uint32_t& Locator::start(Point p) const {
  const int column = std::min(columns_ - 1, static_cast<int>(p.i * per_i_));
  const int row = std::min(rows_ - 1, static_cast<int>(p.j * per_j_));
  return start_[static_cast<std::size_t>(row) * columns_ + column];
}

std::uint32_t Locator::find(const Delaunay& surface, Point p) const { return walk(surface, start(p), p); }

void Locator::find(const Delaunay& surface, std::span<const Point> points,
                   std::span<std::uint32_t> triangles) const {
  for (const Point p : points) prefetch(&start(p));
  std::array<std::uint32_t, kAtOnce> walking;
  std::iota(walking.begin(), walking.end(), 0U);
  for (std::size_t k = 0; k < points.size(); ++k) {
    triangles[k] = start(points[k]);
    prefetch(&surface.triangles()[triangles[k]]);
  }
  for (std::size_t left = points.size(); left > 0;) {
    for (std::size_t w = 0; w < left; ++w) {
      for (const std::uint32_t v : surface.triangles()[triangles[walking[w]]].vertex)
        prefetch(&surface.vertices()[v]);
    }
    std::size_t going = 0;
    for (std::size_t w = 0; w < left; ++w) {
      const std::uint32_t k = walking[w], next = step(surface, triangles[k], points[k]);
      if (next == triangles[k]) continue;
      triangles[k] = next;
      prefetch(&surface.triangles()[next]);
      walking[going++] = k;
    }
    left = going;
  }
}

}  // namespace terrabench::tin
