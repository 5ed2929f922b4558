#include "lod/meters/drawn_triangles.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace terrabench {
namespace {

constexpr std::uint32_t kBlock = 3 * 1024;  // corners

struct Run {
  std::size_t batch;
  std::uint32_t first, count;  // indices
};

std::vector<Run> runs_of(const Frame& frame) {
  std::vector<Run> runs;
  for (std::size_t b = 0; b < frame.batches.size(); ++b) {
    const Batch& batch = frame.batches[b];
    for (std::uint32_t done = 0; done < batch.index_count; done += kBlock) {
      runs.push_back({b, batch.first_index + done, std::min(kBlock, batch.index_count - done)});
    }
  }
  return runs;
}

}  // namespace

void for_drawn_triangles(const Frame& frame, const std::function<void(std::span<const Corner>)>& use) {
  const std::vector<Run> runs = runs_of(frame);
  tbb::parallel_for(std::size_t{0}, runs.size(), [&](std::size_t r) {
    const Run& run = runs[r];
    const Batch& batch = frame.batches[run.batch];
    std::array<Corner, kBlock> corners;
    for (std::uint32_t k = 0; k < run.count; ++k) {
      const glm::vec3 at = vertex_position(frame, batch, batch.base_vertex + frame.indices[run.first + k]);
      corners[k] = {static_cast<int>(std::lround(at.x / frame.cell_x)),
                    static_cast<int>(std::lround(at.z / frame.cell_z)), at.y};
    }
    use({corners.data(), run.count});
  });
}

}  // namespace terrabench
