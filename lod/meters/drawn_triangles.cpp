#include "lod/meters/drawn_triangles.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace terrabench {
namespace {

constexpr std::uint32_t kPart = 3 * 1024;  // indices

// Indices that one task draws.
struct Part {
  std::size_t batch;
  IndexRange indices;
};

std::vector<Part> parts_of(const Frame& frame) {
  std::vector<Part> parts;
  for (std::size_t b = 0; b < frame.batches.size(); ++b) {
    const Batch& batch = frame.batches[b];
    for (std::uint32_t done = 0; done < batch.index_count; done += kPart) {
      parts.push_back({b, {batch.first_index + done, std::min(kPart, batch.index_count - done)}});
    }
  }
  return parts;
}

}  // namespace

void for_drawn_triangles(const Frame& frame, const std::function<void(std::span<const Corner>)>& use) {
  const std::vector<Part> parts = parts_of(frame);
  tbb::parallel_for(std::size_t{0}, parts.size(), [&](std::size_t p) {
    const auto& [batch_number, range] = parts[p];
    const Batch& batch = frame.batches[batch_number];
    std::array<Corner, kPart> corners;
    for (std::uint32_t k = 0; k < range.index_count; ++k) {
      const glm::vec3 at =
          vertex_position(frame, batch, batch.base_vertex + frame.indices[range.first_index + k]);
      corners[k] = {static_cast<int>(std::lround(at.x / frame.cell_x)),
                    static_cast<int>(std::lround(at.z / frame.cell_z)), at.y};
    }
    use({corners.data(), range.index_count});
  });
}

}  // namespace terrabench
