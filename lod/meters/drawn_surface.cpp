#include "lod/meters/drawn_surface.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>

#include "lod/meters/surface_raster.h"
#include "terrain/memory.h"

namespace terrabench {
namespace {

// Twice the signed area of p, q and the point: not negative when the point is on the inner side of the edge
// of a counter-clockwise triangle.
double side(const Corner& p, const Corner& q, double x, double z) {
  return (q.z - p.z) * (x - p.x) - (q.x - p.x) * (z - p.z);
}

}  // namespace

DrawnSurface::DrawnSurface(const Frame& frame, int width, int depth)
    : across_((width - 1) / kTile + 1), down_((depth - 1) / kTile + 1) {
  corners_.reserve(3 * frame.stats.triangles);
  std::mutex adding;
  for_drawn_triangles(frame, [&](std::span<const Corner> corners) {
    const std::lock_guard lock(adding);
    for (std::size_t k = 0; k < corners.size(); k += 3) {
      if (doubled_plan_area(&corners[k]) > 0) corners_.insert(corners_.end(), &corners[k], &corners[k] + 3);
    }
  });
  begins_.assign(static_cast<std::size_t>(across_) * static_cast<std::size_t>(down_) + 1, 0);
  const auto each_tile = [&](const auto& use) {
    for (std::size_t t = 0; t < triangles(); ++t) {
      const Tiles tiles = tiles_of(&corners_[3 * t]);
      for (int z = tiles.z0; z <= tiles.z1; ++z) {
        for (int x = tiles.x0; x <= tiles.x1; ++x)
          use(static_cast<std::size_t>(z) * static_cast<std::size_t>(across_) + static_cast<std::size_t>(x),
              t);
      }
    }
  };
  // Counts first, so that begins_[tile] ends up as the end of the tile before while members are written.
  each_tile([&](std::size_t tile, std::size_t) { ++begins_[tile]; });
  std::uint32_t sum = 0;
  for (std::uint32_t& begin : begins_) begin = sum += begin;
  members_.resize(sum);
  each_tile(
      [&](std::size_t tile, std::size_t t) { members_[--begins_[tile]] = static_cast<std::uint32_t>(t); });
}

DrawnSurface::Tiles DrawnSurface::tiles_of(const Corner* t) const {
  const auto tile = [](int sample, int tiles) { return std::clamp(sample / kTile, 0, tiles - 1); };
  const auto [west, east] = std::minmax({t[0].x, t[1].x, t[2].x});
  const auto [north, south] = std::minmax({t[0].z, t[1].z, t[2].z});
  return {tile(west, across_), tile(east, across_), tile(north, down_), tile(south, down_)};
}

float DrawnSurface::height(double x, double z) const {
  float highest = std::numeric_limits<float>::quiet_NaN();
  const int tile_x = static_cast<int>(x) / kTile, tile_z = static_cast<int>(z) / kTile;
  const std::size_t tile =
      static_cast<std::size_t>(tile_z) * static_cast<std::size_t>(across_) + static_cast<std::size_t>(tile_x);
  for (std::uint32_t k = begins_[tile]; k < begins_[tile + 1]; ++k) {
    const Corner* const t = &corners_[3 * static_cast<std::size_t>(members_[k])];
    const double a = side(t[1], t[2], x, z), b = side(t[2], t[0], x, z), c = side(t[0], t[1], x, z);
    if (a < 0 || b < 0 || c < 0) continue;
    const auto y = static_cast<float>((a * t[0].y + b * t[1].y + c * t[2].y) / (a + b + c));
    if (!(y <= highest)) highest = y;
  }
  return highest;
}

std::size_t DrawnSurface::bytes() const {
  return heap_bytes(corners_.data()) + heap_bytes(begins_.data()) + heap_bytes(members_.data());
}

double height_on_cells(const Heightfield& field, double x, double z) {
  const int i = std::min(static_cast<int>(x), field.width - 2),
            j = std::min(static_cast<int>(z), field.depth - 2);
  const double u = x - i, v = z - j;
  const double east = field.at(i + 1, j), south = field.at(i, j + 1);
  if (u + v <= 1) return field.at(i, j) * (1 - u - v) + east * u + south * v;
  return field.at(i + 1, j + 1) * (u + v - 1) + east * (1 - v) + south * (1 - u);
}

}  // namespace terrabench
