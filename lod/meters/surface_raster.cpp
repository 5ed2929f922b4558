#include "lod/meters/surface_raster.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "lod/meters/drawn_triangles.h"

namespace terrabench {
namespace {

struct Target {
  int width, depth;
  float* heights;

  void raise(int x, int z, float y) const {
    if (x < 0 || z < 0 || x >= width || z >= depth) return;
    const std::atomic_ref<float> height(heights[static_cast<std::size_t>(z) * width + x]);
    float now = height.load(std::memory_order_relaxed);
    while (!(y <= now) && !height.compare_exchange_weak(now, y, std::memory_order_relaxed)) {
    }
  }
};

long long floor_divide(long long a, long long b) {  // b > 0
  const long long quotient = a / b;
  return quotient - (a % b < 0 ? 1 : 0);
}

// The samples on the edge, its first end left out (the next edge draws it). Taken from the lesser end on,
// whichever way the triangle runs it.
void draw_edge(const Target& target, const Corner& from, const Corner& to) {
  target.raise(to.x, to.z, to.y);
  const int parts = std::gcd(to.x - from.x, to.z - from.z);
  if (parts < 2) return;
  const bool forward = std::pair(from.x, from.z) < std::pair(to.x, to.z);
  const Corner &low = forward ? from : to, &high = forward ? to : from;
  const int step_x = (high.x - low.x) / parts, step_z = (high.z - low.z) / parts;
  for (int k = 1; k < parts; ++k) {
    const double y = low.y + (static_cast<double>(high.y) - low.y) * k / parts;
    target.raise(low.x + k * step_x, low.z + k * step_z, static_cast<float>(y));
  }
}

// The samples strictly inside, row by row; a, b, c wind so that the area is positive.
void draw_inside(const Target& target, const Corner* corners, long long area) {
  const Corner &a = corners[0], &b = corners[1], &c = corners[2];
  const auto [first, last] = std::minmax({a.z, b.z, c.z});
  if (last - first < 2 || std::max({a.x, b.x, c.x}) - std::min({a.x, b.x, c.x}) < 2) return;
  const double along_x = (static_cast<double>(b.z - a.z) * (static_cast<double>(c.y) - a.y) -
                          static_cast<double>(c.z - a.z) * (static_cast<double>(b.y) - a.y)) /
                         static_cast<double>(area);
  const double along_z = (static_cast<double>(c.x - a.x) * (static_cast<double>(b.y) - a.y) -
                          static_cast<double>(b.x - a.x) * (static_cast<double>(c.y) - a.y)) /
                         static_cast<double>(area);
  for (int z = std::max(first + 1, 0); z < std::min(last, target.depth); ++z) {
    long long low = 0, high = target.width - 1;
    for (int e = 0; e < 3; ++e) {
      const Corner &p = corners[e], &q = corners[(e + 1) % 3];
      // Inside: (q.z - p.z)·(x - p.x) > (q.x - p.x)·(z - p.z).
      const long long slope = q.z - p.z, limit = static_cast<long long>(q.x - p.x) * (z - p.z);
      if (slope > 0) low = std::max(low, p.x + floor_divide(limit, slope) + 1);
      if (slope < 0) high = std::min(high, p.x - floor_divide(limit, -slope) - 1);
    }
    const double row = a.y + along_z * (z - a.z);
    for (long long x = low; x <= high; ++x) {
      target.raise(static_cast<int>(x), z, static_cast<float>(row + along_x * static_cast<double>(x - a.x)));
    }
  }
}

void draw_triangle(const Target& target, const Corner* corners) {
  const long long area = doubled_plan_area(corners);
  if (area == 0) return;
  for (int e = 0; e < 3; ++e) draw_edge(target, corners[e], corners[(e + 1) % 3]);
  if (area > 0) {
    draw_inside(target, corners, area);
  } else {
    const Corner turned[] = {corners[0], corners[2], corners[1]};
    draw_inside(target, turned, -area);
  }
}

}  // namespace

SurfaceRaster::SurfaceRaster(int width, int depth)
    : width_(width),
      depth_(depth),
      heights_(static_cast<std::size_t>(width) * depth, std::numeric_limits<float>::quiet_NaN()) {}

SurfaceRaster::SurfaceRaster(const Frame& frame, int width, int depth) : SurfaceRaster(width, depth) {
  draw(frame);
}

void SurfaceRaster::draw(const Frame& frame) {
  std::fill(heights_.begin(), heights_.end(), std::numeric_limits<float>::quiet_NaN());
  const Target target{width_, depth_, heights_.data()};
  for_drawn_triangles(frame, [&](std::span<const Corner> corners) {
    for (std::size_t k = 0; k < corners.size(); k += 3) draw_triangle(target, &corners[k]);
  });
}

}  // namespace terrabench
