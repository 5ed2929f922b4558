#include "lod/meters/surface_raster.h"

#include <algorithm>
#include <atomic>
#include <limits>

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
    for (std::size_t k = 0; k < corners.size(); k += 3) {
      if (doubled_plan_area(&corners[k]) <= 0) continue;
      for_samples_on(&corners[k], width_, depth_, [&](int x, int z, float y) { target.raise(x, z, y); });
    }
  });
}

}  // namespace terrabench
