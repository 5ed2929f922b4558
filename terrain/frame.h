// What a level-of-detail method draws: indexed triangles over heights that a renderer keeps on the GPU, and
// the ranges that changed since the last frame. A renderer draws a Frame; meters read the same triangles
// through triangles(). vertex_position() defines where a vertex is; the vertex shader repeats it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>

namespace terrabench {

// Heights at grid points: vertex v lies over sample (i, j) = (v % width, v / width), at x = i·cell_x,
// z = j·cell_z. Vertex width·depth + v lies under vertex v on the floor of its batch: the lower end of a
// skirt.
struct GroundGrid {
  int width = 0, depth = 0;            // samples
  float cell_x = 1.0F, cell_z = 1.0F;  // metres
  std::span<const float> heights;      // width·depth, metres; without no-data
};

// One level of a clipmap: an array of side × side samples that holds a window at most that large, `spacing`
// samples of the full terrain apart, stored toroidally: sample (a, b) of the level's own lattice is
// heights[(b mod side)·side + (a mod side)]. Vertex v is lattice sample corner + (v % side, v / side).
struct ClipLevel {
  int side = 0;          // a power of two
  int spacing = 1;       // 2^level
  glm::ivec2 corner{0};  // lattice coordinates of the window's low corner
  std::span<const float> heights;
  // Transition to the next coarser level (Losasso & Hoppe 2004, §3.3): the blend weight is
  // clamp((max(|x - eye.x|, |z - eye.y|) - from) / (to - from)). In lattice samples of this level, counted
  // from `corner`, so that numbers are small however far from sample 0 the window lies. from = to: no
  // transition.
  glm::vec2 eye{0};
  float from = 0, to = 0;
};

// How far the vertices of a square patch of the grid have morphed to the next coarser level (de Boer 2000,
// §4), as levels with fractions: at l + s, the vertices that level l + 1 drops lie the share s of the way
// from their sample to the surface of level l + 1, whose cells are split through their vertex with odd
// coordinates. The sides' levels are at or above `inside`; both patches at a side have the same value for it.
struct PatchMorph {
  float inside = 0;              // between the batch's level and the next
  std::array<float, 4> sides{};  // north, east, south, west
};

// A square node of the grid whose vertices morph to the next coarser level by their distance from the eye
// (Strugar 2009). At level l it has side × side cells of 2^l samples, split from south-west to north-east;
// the ground's border cuts it, and the last vertices are then the border's. The vertices that level l + 1
// drops, those with an odd coordinate, move vertically to its surface. In the paper they slide to the even
// vertex beside them: the surfaces at both ends of the way are the same. On a side with a coarser neighbour
// they do lie on an even vertex, so that the two nodes share all vertices there.
struct MorphingNode {
  MorphingNode(const GroundGrid& of, int side, int level, glm::ivec2 low);

  // Where the vertex is drawn; bit s of `seams` is set when the neighbour at side s is coarser. Sides: north,
  // east, south, west. O(1).
  glm::ivec2 place(glm::ivec2 vertex, unsigned seams) const;
  // The height of level l + 1 over a sample of level l. O(1).
  float coarser(glm::ivec2 at) const;

  const GroundGrid& grid;
  int step;              // samples, 2^l
  glm::ivec2 low, high;  // corners, samples

 private:
  glm::ivec2 odd(glm::ivec2 at) const;
};

// A vertex of a chunk that morphs to the next coarser chunk's surface (Ulrich 2002): over a sample, and the
// share of its batch on the way from there to another height.
struct ChunkVertex {
  std::uint32_t sample = 0;
  float coarser = 0;  // metres
};

// The share of their way that the vertices of a level have morphed at a distance d from the eye, in metres:
// clamp((d - from) / (to - from)). from = to: they do not morph.
struct MorphRange {
  float from = 0, to = 0;
};

// A square of the grid that the GPU's tessellator divides: the vertex at its low corner, and the logarithms
// to base 2 of the numbers of segments into which it divides the sides, north, east, south and west, and the
// inside, four bits each from the lowest on. All vertices are samples; those beyond the ground's border lie
// over its last ones.
struct TessellatedPatch {
  std::uint32_t corner = 0, factors = 0;
};

// A range of an index array, three indices per triangle.
struct IndexRange {
  std::uint32_t first_index = 0, index_count = 0;
};

// A range of indices to draw, counter-clockwise from above. Vertex = base_vertex + index.
struct Batch {
  std::uint32_t first_index = 0, index_count = 0;
  std::uint32_t base_vertex = 0;
  std::uint16_t level = 0;  // 0 is the finest; number of the clip level when the frame has clip levels
  // Number in Frame::morphs; for morphing nodes, the sides with a coarser neighbour; for skirts, the height
  // of the floor, metres, as the bits of a float.
  std::uint32_t morph = 0;
  float share = 0;  // of its way, 0 to 1, that a chunk has morphed
};

// A mesh in space that a frame draws beside its heights, such as a chunk of an implicit surface; triangles
// are counter-clockwise from the air and may face downwards. Meshes with the same id have the same content in
// all frames of a method, so a renderer uploads an id once and frees it when a frame does not list it.
struct FrameMesh {
  std::uint64_t id = 0;
  std::span<const glm::vec3> positions, normals;  // metres; a unit normal per position
  std::span<const std::uint32_t> indices;         // three per triangle
  bool drawn = true;  // false: out of view; kept on the GPU for later frames, but not drawn in this one

  std::size_t triangles() const { return indices.size() / 3; }
  std::size_t bytes() const { return positions.size_bytes() + normals.size_bytes() + indices.size_bytes(); }
};

// A part of the frame's arrays that differs from the last frame: a range of indices, of grid heights, of
// morphs or of chunk vertices, a rectangle of a clip level in toroidal array coordinates, or a mesh that the
// last frame did not list. The first frame lists everything.
struct DirtyRange {
  enum class Target : std::uint8_t {
    kIndices,
    kHeights,
    kMorphs,
    kChunkVertices,
    kClipLevel,
    kMesh
  } target = Target::kIndices;
  std::uint16_t level = 0;             // of kClipLevel
  std::uint32_t first = 0, count = 0;  // elements, except for kClipLevel; of kMesh: its number, and its bytes
  std::uint16_t x = 0, z = 0, width = 0, depth = 0;  // of kClipLevel, never across the array's border
  std::size_t bytes() const;
};

// Bytes sent to the GPU with every frame, changed or not: per batch a draw command of 20 bytes and a record
// of 16, and per clip level its position and transition, or per level of morphing nodes its range.
inline constexpr std::size_t kBytesPerBatch = 36;
inline constexpr std::size_t kBytesPerClipLevel = 32;
// Of a tessellated frame, its patches are all that is sent with every frame.
inline constexpr std::size_t kBytesPerPatch = sizeof(TessellatedPatch);

struct FrameStats {
  std::size_t triangles = 0;       // drawn
  std::size_t bytes_uploaded = 0;  // of terrain: the sum over the dirty ranges
  std::size_t bytes_commands = 0;  // kBytesPerBatch and kBytesPerClipLevel, or kBytesPerPatch
  std::size_t changes = 0;         // since the last frame: splits and merges, levels changed, nodes toggled

  std::size_t bytes_sent() const { return bytes_uploaded + bytes_commands; }
};

// Points into the method that made it; valid until its next update(). Either grid or clip_levels is set.
struct Frame {
  GroundGrid grid{};
  std::span<const ClipLevel> clip_levels{};
  // For clip levels: the first and last sample of the full terrain along x and z, to which vertices beyond
  // the ground are clamped, and the sample at x = z = 0, so that far from sample 0 metres stay small.
  glm::ivec2 first{0}, last{0}, origin{0};
  float cell_x = 1.0F, cell_z = 1.0F;  // metres between the samples of the full terrain
  std::span<const std::uint32_t> indices{};
  std::span<const Batch> batches{};
  // For patches of patch_side × patch_side cells, a power of two, whose low corner is their batch's base
  // vertex. Empty: all vertices of the grid lie at their samples.
  std::span<const PatchMorph> morphs{};
  int patch_side = 0;
  // By level, for morphing nodes of patch_side × patch_side cells, whose low corner is their batch's base
  // vertex, and the eye from which their vertices' distances count. Empty: no nodes morph.
  std::span<const MorphRange> morph_ranges{};
  glm::vec3 eye{0};
  // Of chunks that morph: vertices from 2·width·depth of the grid on.
  std::span<const ChunkVertex> chunk_vertices{};
  // What the GPU's tessellator divides, patch_side × patch_side cells each. The batches then have the same
  // triangles, for meters and for renderers without a tessellator: neither they nor the indices are sent.
  // Empty: the batches are drawn.
  std::span<const TessellatedPatch> patches{};
  std::span<const FrameMesh> meshes{};
  std::span<const DirtyRange> uploads{};
  FrameStats stats{};
};

// The same triangles, drawn as batches: of a tessellated frame all indices must be sent once.
Frame untessellated(Frame);

// The stats of a frame with these batches, uploads and meshes; `levels`: clip levels, or levels of morphing
// nodes. O(batches + uploads + meshes).
FrameStats count(std::span<const Batch>, std::span<const DirtyRange>, std::size_t changes,
                 std::size_t levels = 0, std::span<const FrameMesh> = {});

// The height of sample (i, j) in the patch whose low corner is sample (i0, j0). O(1).
float morphed_height(const GroundGrid&, int patch_side, const PatchMorph&, int level, glm::ivec2 low,
                     glm::ivec2 at);

// The position of a vertex, metres. O(1).
glm::vec3 vertex_position(const Frame&, const Batch&, std::uint32_t vertex);

// Receives the corners of triangles, three per triangle, in blocks.
using TriangleSink = std::function<void(std::span<const glm::vec3>)>;
// Passes the triangles that the GPU draws for this frame to the sink, batch by batch and then mesh by mesh,
// without meshes that are not drawn.
// O(triangles).
void triangles(const Frame&, const TriangleSink&);

}  // namespace terrabench
