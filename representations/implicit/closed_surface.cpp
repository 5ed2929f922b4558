#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "representations/implicit/block_sweep.h"
#include "terrain/error.h"
#include "terrain/memory.h"

namespace terrabench {
namespace {

// Cells of a block along x and z. Wider blocks share fewer columns, narrower ones keep four planes in a
// cache; along z a block has to read the kernel's width once more.
constexpr int kBlockWidth = 32, kBlockDepth = 128;

template <class T>
void release(std::vector<T>& array) {  // assigning {} would keep the memory
  std::vector<T>().swap(array);
}

// Empties the blocks.
TriangleMesh join(std::vector<SurfaceBlock>& blocks) {
  std::vector<std::size_t> first(blocks.size());
  std::size_t vertices = 0, indices = 0, borders = 0;
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    first[b] = vertices;
    vertices += blocks[b].positions.size();
    indices += blocks[b].indices.size();
    borders += blocks[b].border.size();
  }
  if (vertices >= SurfaceBlock::kForeign) {
    throw usage_error("the mesh has 2³¹ vertices or more", "implicit surface", "choose larger cells");
  }
  require_memory(vertices * 2 * sizeof(glm::vec3) + indices * sizeof(std::uint32_t), "implicit surface");
  std::vector<std::pair<std::uint64_t, std::uint32_t>> shared;
  shared.reserve(borders);
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    for (const auto& [key, vertex] : blocks[b].border) {
      shared.emplace_back(key, static_cast<std::uint32_t>(first[b] + vertex));
    }
    release(blocks[b].border);
  }
  std::sort(shared.begin(), shared.end());
  // One array at a time, each freed in the blocks when it is joined: the peak is the mesh and half as much.
  TriangleMesh mesh;
  const auto append = [&](auto& joined, auto SurfaceBlock::*part, std::size_t size) {
    joined.reserve(size);
    for (SurfaceBlock& block : blocks) {
      joined.insert(joined.end(), (block.*part).begin(), (block.*part).end());
      release(block.*part);
    }
  };
  append(mesh.positions, &SurfaceBlock::positions, vertices);
  append(mesh.normals, &SurfaceBlock::normals, vertices);
  mesh.indices.reserve(indices);
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    SurfaceBlock& block = blocks[b];
    for (std::uint64_t& vertex : block.foreign) {
      const auto at = std::lower_bound(shared.begin(), shared.end(), std::pair(vertex, std::uint32_t{0}));
      vertex = at->second;
    }
    for (const std::uint32_t index : block.indices) {
      mesh.indices.push_back((index & SurfaceBlock::kForeign) != 0
                                 ? static_cast<std::uint32_t>(block.foreign[index & ~SurfaceBlock::kForeign])
                                 : static_cast<std::uint32_t>(first[b] + index));
    }
    release(block.foreign);
    release(block.indices);
  }
  return mesh;
}

// Estimates the mesh of a large lattice from that of a coarse one, since a surface's vertices grow with the
// square of its fineness. Throws environment_error where memory will not hold it.
void check_memory(const SampledField& field, const FieldLattice& lattice, Extractor extractor) {
  constexpr double kLarge = 0x1p31, kCoarse = 0x1p24;  // cells
  const double cells = 1.0 * lattice.cells.x * lattice.cells.y * lattice.cells.z;
  if (cells < kLarge) return;
  const double factor = std::cbrt(cells / kCoarse);
  const TriangleMesh mesh = closed_surface(
      field, {{lattice.low, lattice.high}, static_cast<float>(lattice.cell * factor)}, extractor);
  const double bytes = 2.0 * sizeof(glm::vec3) * static_cast<double>(mesh.positions.size()) +
                       sizeof(std::uint32_t) * static_cast<double>(mesh.indices.size());
  // join() holds the mesh beside what is left of its blocks.
  require_memory(static_cast<std::uint64_t>(1.5 * factor * factor * bytes), "the mesh of an implicit surface",
                 "choose larger cells (cell), or a lower resolution");
}

}  // namespace

SurfaceBlock extract(Extractor extractor, const BlockTask& task) {
  return extractor == Extractor::kMarchingCubes ? marching_cubes(task) : surface_nets(task);
}

TriangleMesh closed_surface(const SampledField& field, const FieldLattice& lattice, Extractor extractor) {
  check_memory(field, lattice, extractor);
  // Cells -1 … cells, one more than the lattice has on each side.
  const auto tiles = [](int cells, int size) { return (cells + 2 + size - 1) / size; };
  const int across = tiles(lattice.cells.x, kBlockWidth), down = tiles(lattice.cells.z, kBlockDepth);
  std::vector<SurfaceBlock> blocks(static_cast<std::size_t>(across) * static_cast<std::size_t>(down));
  tbb::parallel_for(std::size_t{0}, blocks.size(), [&](std::size_t b) {
    const int i = static_cast<int>(b) % across * kBlockWidth - 1,
              j = static_cast<int>(b) / across * kBlockDepth - 1;
    const glm::ivec2 end{std::min(i + kBlockWidth, lattice.cells.x + 1),
                         std::min(j + kBlockDepth, lattice.cells.z + 1)};
    SurfaceBlock& block = blocks[b] = extract(extractor, {field, lattice, {i, j}, end, true});
    block.positions.shrink_to_fit();
    block.normals.shrink_to_fit();
    block.indices.shrink_to_fit();
    block.foreign.shrink_to_fit();
    block.border.shrink_to_fit();
  });
  return join(blocks);
}

}  // namespace terrabench
