#include "lod/chunked/chunk_store.h"

#include <tbb/parallel_for.h>

#include <algorithm>

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
  for (int level = 1; level < tree.levels(); ++level) build(level, tree.grid(level).all(), progress);
  progress.end();
  indices_.shrink_to_fit();
  changes_ = std::vector<DirtyRange>();
}

void ChunkStore::add_patterns() {
  const PatchGrid& grid = tree_.grid(0);
  for (const int z : {0, grid.down() - 1}) {
    for (const int x : {0, grid.across() - 1}) {
      const PatchGrid::Patch square = grid.patch(x, z);
      Slot& pattern = patterns_[static_cast<std::size_t>(grid.shape(square))];
      if (pattern.capacity == 0) put(pattern, exact_pattern(grid_, square, options_.skirts));
    }
  }
}

// Row by row, so that few meshes are kept twice.
void ChunkStore::build(int level, const PatchGrid::PatchRect& some, Progress& progress) {
  const PatchGrid& grid = tree_.grid(level);
  const double side =
      static_cast<double>(grid.side) * static_cast<double>(std::max(grid_.cell_x, grid_.cell_z));
  const auto largest_error = static_cast<float>(options_.error * side);
  std::vector<ChunkMesh> meshes(static_cast<std::size_t>(some.x1 - some.x0 + 1));
  for (int z = some.z0; z <= some.z1; ++z) {
    tbb::parallel_for(std::size_t{0}, meshes.size(), [&](std::size_t k) {
      meshes[k] =
          triangulate(grid_, grid.patch(some.x0 + static_cast<int>(k), z), largest_error, options_.skirts);
    });
    for (int x = some.x0; x <= some.x1; ++x) {
      const ChunkMesh& mesh = meshes[static_cast<std::size_t>(x - some.x0)];
      put(slot(level, x, z), mesh);
      errors_[tree_.number(level, x, z)] = own_or_finer(level, x, z, mesh.error);
    }
    progress.advance();
  }
}

float ChunkStore::own_or_finer(int level, int x, int z, float own) const {
  float error = own;
  for (const auto& [dx, dz] : {std::pair{0, 0}, {1, 0}, {0, 1}, {1, 1}}) {
    const int child_x = 2 * x + dx, child_z = 2 * z + dz;
    if (tree_.has(level - 1, child_x, child_z)) {
      error = std::max(error, this->error(level - 1, child_x, child_z));
    }
  }
  return error;
}

// In its place if it fits there, else at the end.
void ChunkStore::put(Slot& slot, const ChunkMesh& mesh) {
  slot.counts = mesh.counts;
  if (mesh.indices.size() > slot.capacity) {
    unused_ += slot.capacity;
    slot.first = size32(indices_);
    slot.capacity = size32(mesh.indices);
    indices_.insert(indices_.end(), mesh.indices.begin(), mesh.indices.end());
  } else {
    std::ranges::copy(mesh.indices, indices_.begin() + slot.first);
  }
  changes_.push_back({.first = slot.first, .count = size32(mesh.indices)});
}

void ChunkStore::update(const SampleRect& rect) {
  Progress silent;
  for (int level = 1; level < tree_.levels(); ++level) {
    build(level, patches_of(tree_.grid(level), rect), silent);
  }
  if (unused_ > indices_.size() / 2) pack();
}

// Without the places that chunks have left.
void ChunkStore::pack() {
  std::vector<std::uint32_t> packed;
  packed.reserve(indices_.size() - unused_);
  const auto move = [&](Slot& slot) {
    const auto from = indices_.begin() + slot.first;
    slot.first = size32(packed);
    packed.insert(packed.end(), from, from + slot.capacity);
  };
  for (Slot& pattern : patterns_) move(pattern);
  for (Slot& slot : slots_) move(slot);
  indices_ = std::move(packed);
  unused_ = 0;
  changes_.assign(1, {.count = size32(indices_)});
}

void ChunkStore::take_changes(std::vector<DirtyRange>& to) {
  to.insert(to.end(), changes_.begin(), changes_.end());
  changes_.clear();
}

IndexRange ChunkStore::part(int level, int x, int z, Part part) const {
  const PatchGrid& grid = tree_.grid(level);
  const Slot& from =
      level == 0 ? patterns_[static_cast<std::size_t>(grid.shape(grid.patch(x, z)))] : slot(level, x, z);
  IndexRange range{from.first, from.counts[static_cast<std::size_t>(part)]};
  for (int before = 0; before < part; ++before) {
    range.first_index += from.counts[static_cast<std::size_t>(before)];
  }
  return range;
}

void ChunkStore::append_tops(int level, int x, int z, Side side, std::vector<std::uint32_t>& to) const {
  const Part part = side == kNorth  ? kNorthSkirt
                    : side == kEast ? kEastSkirt
                    : side == kWest ? kWestSkirt
                                    : kSouthSkirt;
  const IndexRange range = this->part(level, x, z, part);
  const auto begin = to.end() - to.begin();
  for (const std::uint32_t vertex : indices().subspan(range.first_index, range.index_count)) {
    if (vertex < grid_.heights.size()) to.push_back(vertex);
  }
  std::sort(to.begin() + begin, to.end());
  to.erase(std::unique(to.begin() + begin, to.end()), to.end());
}

Memory ChunkStore::memory() const {
  Memory memory = payload_memory(indices_);
  memory += index_memory(slots_, errors_, changes_);
  return memory;
}

}  // namespace terrabench::chunked
