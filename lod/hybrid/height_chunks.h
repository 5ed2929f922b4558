// A heightfield as chunks of a mesh: two triangles per cell, split as a clipmap splits them. The near surface
// of ground that has no other. Cells need not be square here; cell() is the one along x.
#pragma once

#include <memory>
#include <vector>

#include "lod/hybrid/chunk_layout.h"
#include "terrain/memory.h"

namespace terrabench::hybrid {

class HeightChunks final : public MeshChunks {
 public:
  explicit HeightChunks(const Heightfield& heights);  // must outlive it

  Bounds bounds() const override;  // O(samples)
  float cell() const override { return heights_.cell_x; }
  int cells() const override { return kCells; }
  glm::ivec2 chunks() const override { return layout().chunks; }
  // O(cells). `detail` must be 0.
  TriangleMesh chunk(glm::ivec2 at, int detail) const override;
  std::uint64_t version(glm::ivec2 at) const override {
    const auto& tile = versions_[tile_of(at)];
    return tile ? tile[place_in_tile(at)] : 0;
  }
  // The heights at samples low … high have changed.
  void edited(glm::ivec2 low, glm::ivec2 high);
  Memory memory() const;

  // The chunks cover the ground; the last ones may be narrower.
  ChunkLayout layout() const;

 private:
  static constexpr int kCells = 16;
  static constexpr int kTile = 16;  // chunks along a side of a tile
  static std::size_t index(glm::ivec2 at, int width) {
    return static_cast<std::size_t>(at.y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(at.x);
  }
  std::size_t tile_of(glm::ivec2 chunk) const { return index(chunk / kTile, tiles_x_); }
  static std::size_t place_in_tile(glm::ivec2 chunk) { return index(chunk % kTile, kTile); }

  const Heightfield& heights_;
  int tiles_x_ = 0;
  // Of each chunk, by tiles: 8 B each until a chunk in it is edited, 2 KiB from then on.
  std::vector<std::unique_ptr<std::uint64_t[]>> versions_;
};

// The place of a sample as renderers compute it (vertex_position()), and the surface's unit normal there by
// central differences. O(1)
glm::vec3 place_of(const Heightfield&, glm::ivec2 sample);
glm::vec3 normal_of(const Heightfield&, glm::ivec2 sample);

}  // namespace terrabench::hybrid
