// The mesh of one chunk of chunked LOD: a square of the ground, triangulated by greedy insertion
// (terrain/tin), and skirts that hang from its four sides.
//
// Vertices are samples of the ground, or lie under one on the chunk's floor (GroundGrid). So chunks hold
// indices alone, and heights are kept once for all levels.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "lod/geomipmap/patch_grid.h"
#include "terrain/frame.h"

namespace terrabench::chunked {

// The parts of a chunk, in the order of its indices. At most two skirts face an eye; in this order both
// mostly adjoin the surface and make one batch.
enum Part : int { kSouthSkirt, kWestSkirt, kSurface, kNorthSkirt, kEastSkirt, kParts };

// Of a skirt.
constexpr Side side_of(Part part) {
  return part == kSouthSkirt ? kSouth : part == kWestSkirt ? kWest : part == kNorthSkirt ? kNorth : kEast;
}

struct ChunkMesh {
  std::vector<std::uint32_t> indices;          // vertices; counter-clockwise from above or from outside
  std::array<std::uint32_t, kParts> counts{};  // indices of each part
  float error = 0;                             // largest at any sample of the square, metres
  // Sorted by sample; empty without morphing. With it, index 2·width·depth + k is vertex k.
  std::vector<ChunkVertex> vertices{};
  float morphed_error = 0;  // when all vertices have arrived
};

// A triangulation that misses no sample by more than `largest_error`, metres, if floats allow; `error` says
// by how much it does. The skirt of a side of n edges has n + 1 triangles. O(samples · log vertices).
ChunkMesh triangulate(const GroundGrid&, const PatchGrid::Patch&, float largest_error, bool skirts);

// Two triangles per cell, without error. Vertices are relative to the low corner, so that all squares of this
// shape share one. A skirt has two triangles per edge. O(samples).
ChunkMesh exact_pattern(const GroundGrid&, const PatchGrid::Patch&, bool skirts);

// Lets the vertices morph to another surface: triangles of samples, three per triangle, that cover the
// square. O(samples + triangles).
void morph_to(std::span<const std::uint32_t> coarser, const GroundGrid&, const PatchGrid::Patch&, ChunkMesh&);

}  // namespace terrabench::chunked
