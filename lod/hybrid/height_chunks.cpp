#include "lod/hybrid/height_chunks.h"

#include <cassert>
#include <glm/geometric.hpp>

namespace terrabench::hybrid {

glm::vec3 place_of(const Heightfield& field, glm::ivec2 at) {
  return {static_cast<float>(at.x) * field.cell_x, field.at(at.x, at.y),
          static_cast<float>(at.y) * field.cell_z};
}

glm::vec3 normal_of(const Heightfield& field, glm::ivec2 at) {
  const glm::ivec2 low = glm::max(at - 1, 0), high = glm::min(at + 1, {field.width - 1, field.depth - 1});
  const double rise_x = static_cast<double>(field.at(high.x, at.y)) - field.at(low.x, at.y);
  const double rise_z = static_cast<double>(field.at(at.x, high.y)) - field.at(at.x, low.y);
  return glm::normalize(glm::dvec3(-rise_x / ((high.x - low.x) * static_cast<double>(field.cell_x)), 1,
                                   -rise_z / ((high.y - low.y) * static_cast<double>(field.cell_z))));
}

HeightChunks::HeightChunks(const Heightfield& heights) : heights_(heights) {
  const glm::ivec2 tiles = (layout().chunks + kTile - 1) / kTile;
  tiles_x_ = tiles.x;
  versions_.resize(index({0, tiles.y}, tiles.x));
}

Memory HeightChunks::memory() const {
  Memory memory;
  memory.index = heap_bytes(versions_.data());
  for (const auto& tile : versions_) memory.index += heap_bytes(tile.get());
  return memory;
}

// A normal depends on the samples around its own.
void HeightChunks::edited(glm::ivec2 low, glm::ivec2 high) {
  const ChunkLayout layout = this->layout();
  const glm::ivec2 from = glm::max(low - 2, 0) / kCells,
                   to = glm::min((high + 1) / kCells, layout.chunks - 1);
  for (int b = from.y; b <= to.y; ++b) {
    for (int a = from.x; a <= to.x; ++a) {
      auto& tile = versions_[tile_of({a, b})];
      if (!tile) tile = std::make_unique<std::uint64_t[]>(static_cast<std::size_t>(kTile) * kTile);
      ++tile[place_in_tile({a, b})];
    }
  }
}

Bounds HeightChunks::bounds() const {
  const HeightRange range = height_range(heights_);
  return {{0, range.lowest, 0}, {heights_.extent_x(), range.highest, heights_.extent_z()}};
}

ChunkLayout HeightChunks::layout() const {
  const glm::ivec2 last(heights_.width - 1, heights_.depth - 1);
  return {.first = glm::ivec2(0), .side = kCells, .chunks = (last + kCells - 1) / kCells, .last = last};
}

TriangleMesh HeightChunks::chunk(glm::ivec2 at, int detail) const {
  assert(detail == 0);
  (void)detail;
  const ChunkLayout layout = this->layout();
  const glm::ivec2 low = layout.low(at), cells = layout.high(at) - low;
  const auto vertices = static_cast<std::size_t>(cells.x + 1) * static_cast<std::size_t>(cells.y + 1);
  TriangleMesh mesh;
  mesh.positions.reserve(vertices);
  mesh.normals.reserve(vertices);
  mesh.indices.reserve(static_cast<std::size_t>(6) * cells.x * cells.y);
  for (int j = 0; j <= cells.y; ++j) {
    for (int i = 0; i <= cells.x; ++i) {
      mesh.positions.push_back(place_of(heights_, low + glm::ivec2(i, j)));
      mesh.normals.push_back(normal_of(heights_, low + glm::ivec2(i, j)));
      if (i == cells.x || j == cells.y) continue;
      const auto a = static_cast<std::uint32_t>(j * (cells.x + 1) + i);
      const auto below = a + static_cast<std::uint32_t>(cells.x) + 1;
      mesh.indices.insert(mesh.indices.end(), {a, below, a + 1, a + 1, below, below + 1});
    }
  }
  return mesh;
}

}  // namespace terrabench::hybrid
