// What a level-of-detail method draws: indexed triangles over heights that a renderer keeps on the GPU, with
// the ranges that changed since the last frame. A renderer draws a Frame, and meters read the very same
// triangles through triangles(); vertex_position() is the one definition of where a vertex stands, which the
// vertex shader repeats.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>

namespace terrabench {

// Heights at grid points: vertex v stands over sample (v % width, v / width), at x = i·cell_x, z = j·cell_z.
struct GroundGrid {
  int width = 0, depth = 0;            // samples
  float cell_x = 1.0F, cell_z = 1.0F;  // metres
  std::span<const float> heights;      // width·depth, metres; no no-data
};

// One level of a clipmap: a window of side × side samples, `spacing` samples of the full terrain apart, held
// toroidally: sample (a, b) of the level's own lattice lies at heights[(b mod side)·side + (a mod side)].
// Vertex v is the lattice sample corner + (v % side, v / side).
struct ClipLevel {
  int side = 0;          // a power of two
  int spacing = 1;       // 2^level
  glm::ivec2 corner{0};  // lattice coordinates of the window's low corner
  std::span<const float> heights;
  // Transition to the next coarser level (Losasso & Hoppe 2004, §3.3): the blend weight is
  // clamp((max(|x - eye.x|, |z - eye.y|) - from) / (to - from)), in lattice samples of this level from the
  // corner on: small numbers, however far from sample 0 the window lies. from = to: none.
  glm::vec2 eye{0};
  float from = 0, to = 0;
};

// How far the vertices of a square patch of the grid are on their way to the next coarser level (de Boer
// 2000, §4), as levels with fractions: at l + s the vertices that level l + 1 drops stand the share s of the
// way from their sample to its surface, whose cells are split through their vertex of odd place. Sides are
// north, east, south, west, and at or above `inside`; two patches say the same of the side they share.
struct PatchMorph {
  float inside = 0;  // from the batch's level to one more
  std::array<float, 4> sides{};
};

// A run of indices, three a triangle, counter-clockwise from above. Vertex = base_vertex + index.
struct Batch {
  std::uint32_t first_index = 0, index_count = 0;
  std::uint32_t base_vertex = 0;
  std::uint16_t level = 0;  // 0 is the finest; names the clip level when the frame has clip levels
  std::uint32_t morph = 0;  // of Frame::morphs, when there are any
};

// A part of what the frame points at that differs from the last frame: a run of indices, a run of grid
// heights, a run of morphs, or a rectangle of a clip level in toroidal array coordinates. The first frame
// names everything.
struct DirtyRange {
  enum class Target : std::uint8_t { kIndices, kHeights, kMorphs, kClipLevel } target = Target::kIndices;
  std::uint16_t level = 0;                           // of kClipLevel
  std::uint32_t first = 0, count = 0;                // elements, of all but kClipLevel
  std::uint16_t x = 0, z = 0, width = 0, depth = 0;  // of kClipLevel, never across the array's border
  std::size_t bytes() const;
};

// What goes to the GPU with every frame, changed or not: for each batch a draw command of 20 bytes and a
// record of 16, and the place and blending of each clip level.
inline constexpr std::size_t kBytesPerBatch = 36;
inline constexpr std::size_t kBytesPerClipLevel = 32;

struct FrameStats {
  std::size_t triangles = 0;       // drawn
  std::size_t bytes_uploaded = 0;  // of terrain: the sum over the dirty ranges
  std::size_t bytes_commands = 0;  // of what says how to draw it: batches and clip levels
  // What the method did to get here: splits and merges, levels changed, nodes toggled.
  std::size_t changes = 0;

  std::size_t bytes_sent() const { return bytes_uploaded + bytes_commands; }
};

// Points into the method that made it; valid until its next update(). Either grid or levels is set.
struct Frame {
  GroundGrid grid;
  std::span<const ClipLevel> levels;
  // Of clip levels: the first and last sample of the full terrain along x and z, where vertices beyond the
  // ground stand, and the sample that stands at x = z = 0, so that far from sample 0 metres stay small.
  glm::ivec2 first{0}, last{0}, origin{0};
  float cell_x = 1.0F, cell_z = 1.0F;  // metres between the samples of the full terrain
  std::span<const std::uint32_t> indices;
  std::span<const Batch> batches;
  // Of patches of patch_side cells, a power of two, whose low corner is their batch's base vertex. None: all
  // vertices of the grid stand at their samples.
  std::span<const PatchMorph> morphs{};
  int patch_side = 0;
  std::span<const DirtyRange> uploads;
  FrameStats stats;
};

// Sums triangles and bytes of the batches, uploads and so many clip levels. O(batches + uploads).
FrameStats count(std::span<const Batch>, std::span<const DirtyRange>, std::size_t changes,
                 std::size_t clip_levels = 0);

// The height of sample (i, j) in the patch whose low corner is sample (i0, j0). O(1).
float morphed_height(const GroundGrid&, int patch_side, const PatchMorph&, int level, glm::ivec2 low,
                     glm::ivec2 at);

// Where the vertex stands, metres. O(1).
glm::vec3 vertex_position(const Frame&, const Batch&, std::uint32_t vertex);

// Receives the corners of triangles, three a triangle, in blocks.
using TriangleSink = std::function<void(std::span<const glm::vec3>)>;
// The triangles that the GPU draws of this frame, batch by batch. O(triangles).
void triangles(const Frame&, const TriangleSink&);

}  // namespace terrabench
