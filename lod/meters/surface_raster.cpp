#include "lod/meters/surface_raster.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>
#include <vector>

namespace terrabench {
namespace {

constexpr std::uint32_t kPart = 3 * 1024;  // indices

// Indices that one task draws, of a batch or a mesh.
struct Part {
  const Batch* batch;
  const FrameMesh* mesh;
  IndexRange indices;
};

std::vector<Part> parts_of(const Frame& frame) {
  std::vector<Part> parts;
  const auto divide = [&](const Batch* batch, const FrameMesh* mesh, IndexRange all) {
    for (std::uint32_t done = 0; done < all.index_count; done += kPart) {
      parts.push_back({batch, mesh, {all.first_index + done, std::min(kPart, all.index_count - done)}});
    }
  };
  for (const Batch& batch : frame.batches) divide(&batch, nullptr, {batch.first_index, batch.index_count});
  for (const FrameMesh& mesh : frame.meshes) {
    if (mesh.drawn) divide(nullptr, &mesh, {0, static_cast<std::uint32_t>(mesh.indices.size())});
  }
  return parts;
}

}  // namespace

void for_drawn_triangles(const Frame& frame, const std::function<void(std::span<const Corner>)>& use) {
  const std::vector<Part> parts = parts_of(frame);
  tbb::parallel_for(std::size_t{0}, parts.size(), [&](std::size_t p) {
    const auto& [batch, mesh, range] = parts[p];
    std::array<Corner, kPart> corners;
    for (std::uint32_t k = 0; k < range.index_count; ++k) {
      const std::uint32_t index = range.first_index + k;
      const glm::vec3 at = mesh != nullptr
                               ? mesh->positions[mesh->indices[index]]
                               : vertex_position(frame, *batch, batch->base_vertex + frame.indices[index]);
      corners[k] = {static_cast<int>(std::lround(at.x / frame.cell_x)),
                    static_cast<int>(std::lround(at.z / frame.cell_z)), at.y};
    }
    use({corners.data(), range.index_count});
  });
}

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
