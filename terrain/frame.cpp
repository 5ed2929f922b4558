#include "terrain/frame.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>

namespace terrabench {
namespace {

glm::vec3 grid_position(const GroundGrid& grid, std::uint32_t vertex) {
  const auto width = static_cast<std::uint32_t>(grid.width);
  return {static_cast<float>(vertex % width) * grid.cell_x, grid.heights[vertex],
          static_cast<float>(vertex / width) * grid.cell_z};
}

float clip_height(const ClipLevel& level, int a, int b) {
  const int mask = level.side - 1;
  return level.heights[static_cast<std::size_t>(b & mask) * level.side + (a & mask)];
}

float blend(const ClipLevel& level, int a, int b) {
  if (level.from >= level.to) return 0;
  const float distance =
      std::max(std::abs(static_cast<float>(a) - level.eye.x), std::abs(static_cast<float>(b) - level.eye.y));
  return std::clamp((distance - level.from) / (level.to - level.from), 0.0F, 1.0F);
}

glm::vec3 clip_position(const Frame& frame, const Batch& batch, std::uint32_t vertex) {
  const ClipLevel& level = frame.levels[batch.level];
  const auto side = static_cast<std::uint32_t>(level.side);
  const int a = level.corner.x + static_cast<int>(vertex % side);
  const int b = level.corner.y + static_cast<int>(vertex / side);
  float y = clip_height(level, a, b);
  const float weight = blend(level, a, b);
  if (weight > 0) {
    // The coarser level's own samples, not this level's means: the two agree to the bit where they meet.
    // Beyond the ground only the outer one, which stands at the border too.
    const ClipLevel& coarser = frame.levels[batch.level + 1];
    const auto ends = [&](int lattice, int last) {
      const int odd = lattice & 1;
      int low = (lattice - odd) / 2, high = (lattice + odd) / 2;
      if (lattice * level.spacing >= last) low = high;
      if (lattice * level.spacing <= 0) high = low;
      return glm::ivec2(low, high);
    };
    const glm::ivec2 x = ends(a, frame.last.x), z = ends(b, frame.last.y);
    const float there = 0.5F * (clip_height(coarser, x[0], z[1]) + clip_height(coarser, x[1], z[0]));
    y = glm::mix(y, there, weight);
  }
  const int i = std::clamp(a * level.spacing, 0, frame.last.x);
  const int j = std::clamp(b * level.spacing, 0, frame.last.y);
  return {static_cast<float>(i) * frame.cell_x, y, static_cast<float>(j) * frame.cell_z};
}

}  // namespace

std::size_t DirtyRange::bytes() const {
  return target == Target::kClipLevel ? std::size_t{4} * width * depth : std::size_t{4} * count;
}

FrameStats count(std::span<const Batch> batches, std::span<const DirtyRange> uploads, std::size_t changes,
                 std::size_t clip_levels) {
  FrameStats stats{.bytes_commands = kBytesPerBatch * batches.size() + kBytesPerClipLevel * clip_levels,
                   .changes = changes};
  for (const Batch& batch : batches) stats.triangles += batch.index_count / 3;
  for (const DirtyRange& range : uploads) stats.bytes_uploaded += range.bytes();
  return stats;
}

glm::vec3 vertex_position(const Frame& frame, const Batch& batch, std::uint32_t vertex) {
  return frame.levels.empty() ? grid_position(frame.grid, vertex) : clip_position(frame, batch, vertex);
}

void triangles(const Frame& frame, const TriangleSink& sink) {
  std::array<glm::vec3, 3 * 256> corners;
  for (const Batch& batch : frame.batches) {
    for (std::uint32_t done = 0; done < batch.index_count;) {
      const std::uint32_t n = std::min<std::uint32_t>(corners.size(), batch.index_count - done);
      for (std::uint32_t k = 0; k < n; ++k) {
        corners[k] =
            vertex_position(frame, batch, batch.base_vertex + frame.indices[batch.first_index + done + k]);
      }
      sink({corners.data(), n});
      done += n;
    }
  }
}

}  // namespace terrabench
