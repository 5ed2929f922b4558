#include "lod/chunked/chunk_store.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <numeric>

namespace terrabench::chunked {
namespace {

std::uint32_t size32(const auto& values) { return static_cast<std::uint32_t>(values.size()); }

}  // namespace

ChunkStore::ChunkStore(const GroundGrid& grid, const NodeTree& tree, const Options& options,
                       Progress& progress)
    : grid_(grid),
      tree_(tree),
      options_(options),
      slots_(tree.count() - tree.grid(0).count()),
      errors_(tree.count(), 0) {
  add_patterns();
  std::size_t rows = 0;
  for (int level = 1; level < tree.levels(); ++level)
    rows += static_cast<std::size_t>(tree.grid(level).down());
  progress.begin("triangulating chunks", rows);
  for (int level = tree.levels() - 1; level > 0; --level) build(level, tree.grid(level).all(), progress);
  for (int level = 1; level < tree.levels(); ++level) raise_errors(level, tree.grid(level).all());
  progress.end();
  indices_.shrink_to_fit();
  vertices_.shrink_to_fit();
  changes_ = std::vector<DirtyRange>();
}

void ChunkStore::add_patterns() {
  const PatchGrid& grid = tree_.grid(0);
  for (const int z : {0, grid.down() - 1}) {
    for (const int x : {0, grid.across() - 1}) {
      const PatchGrid::Patch square = grid.patch(x, z);
      Slot& pattern = patterns_[static_cast<std::size_t>(grid.shape(square))];
      if (pattern.indices.capacity > 0) continue;
      ChunkMesh mesh = exact_pattern(grid_, square, options_.skirts);
      put(pattern, mesh);
    }
  }
}

// Row by row, so that few meshes are kept twice. From the coarsest level down: chunks morph to the coarser
// ones.
void ChunkStore::build(int level, const PatchGrid::PatchRect& some, Progress& progress) {
  std::vector<ChunkMesh> meshes(static_cast<std::size_t>(some.x1 - some.x0 + 1));
  for (int z = some.z0; z <= some.z1; ++z) {
    tbb::parallel_for(some.x0, some.x1 + 1,
                      [&](int x) { meshes[static_cast<std::size_t>(x - some.x0)] = mesh_of(level, x, z); });
    for (int x = some.x0; x <= some.x1; ++x) {
      ChunkMesh& mesh = meshes[static_cast<std::size_t>(x - some.x0)];
      put(slot(level, x, z), mesh);
      errors_[tree_.number(level, x, z)] = mesh.error;
    }
    progress.advance();
  }
}

ChunkMesh ChunkStore::mesh_of(int level, int x, int z) const {
  const PatchGrid& grid = tree_.grid(level);
  const double side =
      static_cast<double>(grid.side) * static_cast<double>(std::max(grid_.cell_x, grid_.cell_z));
  const PatchGrid::Patch square = grid.patch(x, z);
  ChunkMesh mesh = triangulate(grid_, square, static_cast<float>(options_.error * side), options_.skirts);
  if (!options_.morph) return mesh;
  const bool coarsest = level + 1 == tree_.levels();  // stays as it is
  const IndexRange range = coarsest ? IndexRange{} : part(level + 1, x / 2, z / 2, kSurface);
  std::vector<std::uint32_t> surface;
  for (const std::uint32_t vertex : indices().subspan(range.first_index, range.index_count)) {
    surface.push_back(sample(vertex));
  }
  if (coarsest) {
    surface.assign(mesh.indices.begin() + mesh.counts[kSouthSkirt] + mesh.counts[kWestSkirt],
                   mesh.indices.end() - mesh.counts[kNorthSkirt] - mesh.counts[kEastSkirt]);
  }
  morph_to(surface, grid_, square, mesh);
  return mesh;
}

// From their own to no less than those below.
void ChunkStore::raise_errors(int level, const PatchGrid::PatchRect& some) {
  for (int z = some.z0; z <= some.z1; ++z) {
    for (int x = some.x0; x <= some.x1; ++x) {
      float& error = errors_[tree_.number(level, x, z)];
      for (const auto& [dx, dz] : {std::pair{0, 0}, {1, 0}, {0, 1}, {1, 1}}) {
        const int child_x = 2 * x + dx, child_z = 2 * z + dz;
        if (tree_.has(level - 1, child_x, child_z)) {
          error = std::max(error, this->error(level - 1, child_x, child_z));
        }
      }
    }
  }
}

void ChunkStore::put(Slot& slot, ChunkMesh& mesh) {
  slot.counts = mesh.counts;
  slot.morphed_error = mesh.morphed_error;
  put(slot.vertices, std::span<const ChunkVertex>(mesh.vertices), vertices_,
      DirtyRange::Target::kChunkVertices);
  for (std::uint32_t& index : mesh.indices) {
    if (index >= 2 * grid_.heights.size()) index += slot.vertices.first;
  }
  put(slot.indices, std::span<const std::uint32_t>(mesh.indices), indices_, DirtyRange::Target::kIndices);
}

// In its place if it fits there, else at the end.
template <class T>
void ChunkStore::put(Place& place, std::span<const T> what, std::vector<T>& array,
                     DirtyRange::Target target) {
  if (what.empty()) return;
  if (what.size() > place.capacity) {
    unused_ += place.capacity;
    place = {size32(array), size32(what)};
    array.insert(array.end(), what.begin(), what.end());
  } else {
    std::ranges::copy(what, array.begin() + place.first);
  }
  changes_.push_back({.target = target, .first = place.first, .count = size32(what)});
}

void ChunkStore::update(const SampleRect& rect) {
  Progress silent;
  const int levels = tree_.levels();
  const auto rebuilt = [&](int level) {
    if (!options_.morph || level + 1 == levels) return tree_.grid(level).holding(rect.low, rect.high);
    const PatchGrid::PatchRect coarser = tree_.grid(level + 1).holding(rect.low, rect.high);
    const PatchGrid& grid = tree_.grid(level);
    return PatchGrid::PatchRect{2 * coarser.x0, std::min(2 * coarser.x1 + 1, grid.across() - 1),
                                2 * coarser.z0, std::min(2 * coarser.z1 + 1, grid.down() - 1)};
  };
  for (int level = levels - 1; level > 0; --level) build(level, rebuilt(level), silent);
  for (int level = 1; level < levels; ++level) raise_errors(level, rebuilt(level));
  if (unused_ > (indices_.size() + vertices_.size()) / 2) pack();
}

// Without the places that chunks have left.
void ChunkStore::pack() {
  const std::vector<std::uint32_t> indices = std::move(indices_);
  const std::vector<ChunkVertex> vertices = std::move(vertices_);
  indices_ = {};
  vertices_ = {};
  unused_ = 0;
  const auto move = [&](Slot& slot) {
    ChunkMesh mesh{{}, slot.counts, 0, {}, slot.morphed_error};
    const auto first = indices.begin() + slot.indices.first;
    mesh.indices.assign(first, first + std::reduce(slot.counts.begin(), slot.counts.end()));
    const auto begin = vertices.begin() + slot.vertices.first;
    mesh.vertices.assign(begin, begin + slot.vertices.capacity);
    for (std::uint32_t& index : mesh.indices) {
      if (index >= 2 * grid_.heights.size()) index -= slot.vertices.first;
    }
    slot.indices = slot.vertices = {};
    put(slot, mesh);
  };
  for (Slot& pattern : patterns_) move(pattern);
  for (Slot& slot : slots_) move(slot);
  changes_ = std::vector<DirtyRange>();
  changes_.push_back({.count = size32(indices_)});
  if (options_.morph) {
    changes_.push_back({.target = DirtyRange::Target::kChunkVertices, .count = size32(vertices_)});
  }
}

void ChunkStore::take_changes(std::vector<DirtyRange>& to) {
  to.insert(to.end(), changes_.begin(), changes_.end());
  changes_.clear();
}

IndexRange ChunkStore::part(int level, int x, int z, Part part) const {
  const PatchGrid& grid = tree_.grid(level);
  const Slot& from =
      level == 0 ? patterns_[static_cast<std::size_t>(grid.shape(grid.patch(x, z)))] : slot(level, x, z);
  IndexRange range{from.indices.first, from.counts[static_cast<std::size_t>(part)]};
  for (int before = 0; before < part; ++before) {
    range.first_index += from.counts[static_cast<std::size_t>(before)];
  }
  return range;
}

std::uint32_t ChunkStore::sample(std::uint32_t vertex) const {
  const std::size_t samples = grid_.heights.size();
  return vertex < samples ? vertex : vertices_[vertex - 2 * samples].sample;
}

float ChunkStore::lowest(std::uint32_t vertex) const {
  const std::size_t samples = grid_.heights.size();
  if (vertex < samples) return grid_.heights[vertex];
  const ChunkVertex& moving = vertices_[vertex - 2 * samples];
  return std::min(grid_.heights[moving.sample], moving.coarser);
}

void ChunkStore::append_tops(int level, int x, int z, Side side, std::vector<std::uint32_t>& to) const {
  const Part part = side == kNorth  ? kNorthSkirt
                    : side == kEast ? kEastSkirt
                    : side == kWest ? kWestSkirt
                                    : kSouthSkirt;
  const IndexRange range = this->part(level, x, z, part);
  const auto begin = to.end() - to.begin();
  for (const std::uint32_t vertex : indices().subspan(range.first_index, range.index_count)) {
    if (vertex < grid_.heights.size() || vertex >= 2 * grid_.heights.size()) to.push_back(vertex);
  }
  std::sort(to.begin() + begin, to.end());
  to.erase(std::unique(to.begin() + begin, to.end()), to.end());
}

Memory ChunkStore::memory() const {
  Memory memory = payload_memory(indices_, vertices_);
  memory += index_memory(slots_, errors_, changes_);
  return memory;
}

}  // namespace terrabench::chunked
