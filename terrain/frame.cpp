#include "terrain/frame.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <utility>

namespace terrabench {
namespace {

glm::vec3 grid_position(const GroundGrid& grid, std::uint32_t vertex) {
  const auto width = static_cast<std::uint32_t>(grid.width);
  return {static_cast<float>(vertex % width) * grid.cell_x, grid.heights[vertex],
          static_cast<float>(vertex / width) * grid.cell_z};
}

// Interpolates from a to b; rounding never leads beyond either.
float between(float a, float b, float share) {
  return std::clamp(a + (b - a) * share, std::min(a, b), std::max(a, b));
}

// A patch that morphs to the next coarser level.
struct MorphingPatch {
  const GroundGrid& grid;
  const PatchMorph& morph;
  int level;
  glm::ivec2 low, high;  // corners, samples

  float sample(glm::ivec2 at) const {
    return grid.heights[static_cast<std::size_t>(at.y) * static_cast<std::size_t>(grid.width) +
                        static_cast<std::size_t>(at.x)];
  }
  bool on_border(glm::ivec2 at) const {
    return at.x == low.x || at.x == high.x || at.y == low.y || at.y == high.y;
  }

  // The height of a vertex on a side. It depends only on the samples along the side and on the side's value
  // in the morph, so the neighbouring patch has the same vertices. Corners do not move.
  float on_side(glm::ivec2 at) const {
    const int along = at.y == low.y || at.y == high.y ? 0 : 1;
    const float target = along == 0 ? morph.sides[at.y == low.y ? 0 : 2] : morph.sides[at.x == low.x ? 3 : 1];
    const int step = 1 << static_cast<int>(target);
    const float share = target - std::floor(target);
    if (share <= 0 || at[along] == high[along] || ((at[along] - low[along]) & (2 * step - 1)) != step) {
      return sample(at);
    }
    glm::ivec2 before = at, after = at;
    before[along] -= step;
    after[along] = std::min(after[along] + step, high[along]);
    const float way = static_cast<float>(step) / static_cast<float>(after[along] - before[along]);
    return between(sample(at), between(sample(before), sample(after), way), share);
  }

  float shown(glm::ivec2 at) const { return on_border(at) ? on_side(at) : sample(at); }

  float height(glm::ivec2 at) const {
    if (on_border(at)) return on_side(at);
    const int step = 1 << level;
    const float share = morph.inside - static_cast<float>(level);
    const glm::ivec2 odd((at.x - low.x) & step, (at.y - low.y) & step);
    if (share <= 0 || odd == glm::ivec2(0)) return sample(at);
    glm::ivec2 before = at - odd, after = glm::min(at + odd, high);
    const glm::ivec2 cell = before - low;
    if (odd.x != 0 && odd.y != 0 && ((cell.x ^ cell.y) & (2 * step)) != 0) std::swap(before.y, after.y);
    const int along = odd.x != 0 ? 0 : 1;
    const float way = static_cast<float>(step) / static_cast<float>(after[along] - before[along]);
    return between(sample(at), between(shown(before), shown(after), way), share);
  }
};

glm::vec3 morphed_position(const Frame& frame, const Batch& batch, std::uint32_t vertex) {
  const auto width = static_cast<std::uint32_t>(frame.grid.width);
  const auto place = [&](std::uint32_t v) { return glm::ivec2(v % width, v / width); };
  glm::vec3 position = grid_position(frame.grid, vertex);
  position.y = morphed_height(frame.grid, frame.patch_side, frame.morphs[batch.morph], batch.level,
                              place(batch.base_vertex), place(vertex));
  return position;
}

// The share of its way that a vertex has morphed at this distance.
float morphed_share(const MorphRange& range, float distance) {
  if (range.from >= range.to) return 0;
  return std::clamp((distance - range.from) / (range.to - range.from), 0.0F, 1.0F);
}

glm::vec3 node_position(const Frame& frame, const Batch& batch, std::uint32_t vertex) {
  const auto width = static_cast<std::uint32_t>(frame.grid.width);
  const auto place = [&](std::uint32_t v) { return glm::ivec2(v % width, v / width); };
  const MorphingNode node(frame.grid, frame.patch_side, batch.level, place(batch.base_vertex));
  const glm::ivec2 at = node.place(place(vertex), batch.morph);
  glm::vec3 position =
      grid_position(frame.grid, static_cast<std::uint32_t>(at.y) * width + static_cast<std::uint32_t>(at.x));
  const float share = morphed_share(frame.morph_ranges[batch.level], glm::distance(frame.eye, position));
  if (share > 0) position.y = between(position.y, node.coarser(at), share);
  return position;
}

float clip_height(const ClipLevel& level, int a, int b) {
  const int mask = level.side - 1;
  return level.heights[static_cast<std::size_t>(b & mask) * level.side + (a & mask)];
}

// The blend weight of the window's sample (x, z).
float blend_weight(const ClipLevel& level, int x, int z) {
  if (level.from >= level.to) return 0;
  const float distance =
      std::max(std::abs(static_cast<float>(x) - level.eye.x), std::abs(static_cast<float>(z) - level.eye.y));
  return std::clamp((distance - level.from) / (level.to - level.from), 0.0F, 1.0F);
}

glm::vec3 plain_position(const Frame& frame, const Batch& batch, std::uint32_t vertex) {
  const auto samples = static_cast<std::uint32_t>(frame.grid.heights.size());
  if (vertex < samples) return grid_position(frame.grid, vertex);
  if (vertex < 2 * samples) {
    glm::vec3 position = grid_position(frame.grid, vertex - samples);
    position.y = std::bit_cast<float>(batch.morph);
    return position;
  }
  const ChunkVertex& moving = frame.chunk_vertices[vertex - 2 * samples];
  glm::vec3 position = grid_position(frame.grid, moving.sample);
  position.y = between(position.y, moving.coarser, batch.share);
  return position;
}

glm::vec3 clip_position(const Frame& frame, const Batch& batch, std::uint32_t vertex) {
  const ClipLevel& level = frame.clip_levels[batch.level];
  const auto side = static_cast<std::uint32_t>(level.side);
  const auto x = static_cast<int>(vertex % side), z = static_cast<int>(vertex / side);
  const int a = level.corner.x + x, b = level.corner.y + z;
  float y = clip_height(level, a, b);
  const float weight = blend_weight(level, x, z);
  if (weight > 0) {
    // The coarser level's own samples, not means of this level's, so that the two surfaces agree to the bit
    // where they meet. Beyond the ground only the outer sample, which is clamped to the border as well.
    const ClipLevel& coarser = frame.clip_levels[batch.level + 1];
    const auto ends = [&](int lattice, int first, int last) {
      const int odd = lattice & 1;
      int low = (lattice - odd) / 2, high = (lattice + odd) / 2;
      if (lattice * level.spacing >= last) low = high;
      if (lattice * level.spacing <= first) high = low;
      return glm::ivec2(low, high);
    };
    const glm::ivec2 i = ends(a, frame.first.x, frame.last.x), j = ends(b, frame.first.y, frame.last.y);
    const float there = 0.5F * (clip_height(coarser, i[0], j[1]) + clip_height(coarser, i[1], j[0]));
    y = glm::mix(y, there, weight);
  }
  const int i = std::clamp(a * level.spacing, frame.first.x, frame.last.x) - frame.origin.x;
  const int j = std::clamp(b * level.spacing, frame.first.y, frame.last.y) - frame.origin.y;
  return {static_cast<float>(i) * frame.cell_x, y, static_cast<float>(j) * frame.cell_z};
}

}  // namespace

std::size_t DirtyRange::bytes() const {
  if (target == Target::kClipLevel) return std::size_t{4} * width * depth;
  if (target == Target::kMesh) return count;
  if (target == Target::kChunkVertices) return count * sizeof(ChunkVertex);
  return count * (target == Target::kMorphs ? sizeof(PatchMorph) : 4);
}

Frame untessellated(Frame frame) {
  if (frame.patches.empty()) return frame;
  frame.patches = {};
  frame.patch_side = 0;
  return frame;
}

FrameStats count(std::span<const Batch> batches, std::span<const DirtyRange> uploads, std::size_t changes,
                 std::size_t levels, std::span<const FrameMesh> meshes) {
  FrameStats stats{.bytes_commands = kBytesPerBatch * batches.size() + kBytesPerClipLevel * levels,
                   .changes = changes};
  for (const Batch& batch : batches) stats.triangles += batch.index_count / 3;
  for (const FrameMesh& mesh : meshes) {
    if (mesh.drawn) stats.triangles += mesh.triangles();
  }
  for (const DirtyRange& range : uploads) stats.bytes_uploaded += range.bytes();
  return stats;
}

float morphed_height(const GroundGrid& grid, int patch_side, const PatchMorph& morph, int level,
                     glm::ivec2 low, glm::ivec2 at) {
  const glm::ivec2 high = glm::min(low + patch_side, glm::ivec2(grid.width, grid.depth) - 1);
  return MorphingPatch{grid, morph, level, low, high}.height(at);
}

MorphingNode::MorphingNode(const GroundGrid& of, int side, int level, glm::ivec2 corner)
    : grid(of),
      step(1 << level),
      low(corner),
      high(glm::min(corner + (side << level), glm::ivec2(of.width, of.depth) - 1)) {}

// `step` along the axes in which the vertex lies between those of the next coarser level, which keeps the
// last.
glm::ivec2 MorphingNode::odd(glm::ivec2 at) const {
  return {at.x == high.x ? 0 : (at.x - low.x) & step, at.y == high.y ? 0 : (at.y - low.y) & step};
}

// On north and west sides vertices move to lower coordinates, on the others to higher, so that the triangles
// around each form a fan.
glm::ivec2 MorphingNode::place(glm::ivec2 vertex, unsigned seams) const {
  const auto seam = [&](int side) { return (seams >> side & 1U) != 0; };
  const glm::ivec2 odd = this->odd(vertex), before = vertex - odd, after = glm::min(vertex + odd, high);
  if (vertex.y == low.y && seam(0)) return before;
  if (vertex.y == high.y && seam(2)) return after;
  if (vertex.x == low.x && seam(3)) return before;
  if (vertex.x == high.x && seam(1)) return after;
  return vertex;
}

float MorphingNode::coarser(glm::ivec2 at) const {
  const auto height = [&](int x, int z) {
    return grid.heights[static_cast<std::size_t>(z) * static_cast<std::size_t>(grid.width) +
                        static_cast<std::size_t>(x)];
  };
  const glm::ivec2 odd = this->odd(at), before = at - odd, after = glm::min(at + odd, high);
  if (odd == glm::ivec2(0)) return height(at.x, at.y);
  const glm::vec2 way = glm::vec2(at - before) / glm::vec2(glm::max(after - before, 1));
  // In the middle of a cell of level l + 1, at `way` from its north-western corner: on its diagonal, or
  // beyond it where the border cuts the cell.
  const float south_west = height(before.x, after.y), north_east = height(after.x, before.y);
  if (odd.x == 0) return between(north_east, south_west, way.y);
  if (odd.y == 0) return between(south_west, north_east, way.x);
  const float diagonal = between(south_west, north_east, (1 - way.y) / (2 - way.x - way.y));
  return between(diagonal, height(after.x, after.y), way.x + way.y - 1);
}

glm::vec3 vertex_position(const Frame& frame, const Batch& batch, std::uint32_t vertex) {
  if (!frame.clip_levels.empty()) return clip_position(frame, batch, vertex);
  if (!frame.morph_ranges.empty()) return node_position(frame, batch, vertex);
  return frame.morphs.empty() ? plain_position(frame, batch, vertex) : morphed_position(frame, batch, vertex);
}

namespace {

using Corners = std::array<glm::vec3, 3 * 256>;

void mesh_triangles(const FrameMesh& mesh, Corners& corners, const TriangleSink& sink) {
  for (std::size_t done = 0; done < mesh.indices.size();) {
    const std::size_t n = std::min(corners.size(), mesh.indices.size() - done);
    for (std::size_t k = 0; k < n; ++k) corners[k] = mesh.positions[mesh.indices[done + k]];
    sink({corners.data(), n});
    done += n;
  }
}

}  // namespace

void triangles(const Frame& frame, const TriangleSink& sink) {
  Corners corners;
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
  for (const FrameMesh& mesh : frame.meshes) {
    if (mesh.drawn) mesh_triangles(mesh, corners, sink);
  }
}

}  // namespace terrabench
