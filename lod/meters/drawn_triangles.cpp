#include "lod/meters/drawn_triangles.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
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

}  // namespace terrabench
