#include "lod/brute_force/brute_force.h"

#include <algorithm>

#include "terrain/frustum.h"
#include "terrain/memory.h"

namespace terrabench {

std::unique_ptr<Lod> BruteForce::build(const LodGround& from, const Parameters&, Progress&) {
  const Heightfield& ground = from.heights;
  check_ground(ground);
  return std::make_unique<BruteForce>(ground);
}

BruteForce::BruteForce(const Heightfield& ground) : grid_(grid_of(ground)) {
  const auto blocks_along = [](int samples) { return (samples - 2) / kBlock + 1; };
  blocks_.reserve(static_cast<std::size_t>(blocks_along(grid_.width)) * blocks_along(grid_.depth));
  for (int j0 = 0; j0 < grid_.depth - 1; j0 += kBlock) {
    for (int i0 = 0; i0 < grid_.width - 1; i0 += kBlock) add_block(i0, j0);
  }
  batches_.reserve(blocks_.size());
}

void BruteForce::add_block(int i0, int j0) {
  const int columns = std::min(kBlock, grid_.width - 1 - i0);
  const int rows = std::min(kBlock, grid_.depth - 1 - j0);
  const auto corner = static_cast<std::uint32_t>(j0) * static_cast<std::uint32_t>(grid_.width) + i0;
  blocks_.push_back({corner, shape_of(columns, rows), 0, 0});
  measure(blocks_.back());
}

void BruteForce::measure(Block& block) const {
  const Shape& shape = shapes_[block.shape];
  block.lowest = block.highest = grid_.heights[block.corner];
  for (int j = 0; j <= shape.rows; ++j) {
    const float* const row = &grid_.heights[block.corner + static_cast<std::size_t>(j) * grid_.width];
    const auto [low, high] = std::minmax_element(row, row + shape.columns + 1);
    block.lowest = std::min(block.lowest, *low);
    block.highest = std::max(block.highest, *high);
  }
}

// Blocks share their border samples.
void BruteForce::edited(const SampleRect& rect) {
  check_edit(rect, grid_.width, grid_.depth);
  const int across = (grid_.width - 2) / kBlock + 1, down = (grid_.depth - 2) / kBlock + 1;
  for (int z = std::max(rect.low.y - 1, 0) / kBlock; z <= std::min(rect.high.y / kBlock, down - 1); ++z) {
    for (int x = std::max(rect.low.x - 1, 0) / kBlock; x <= std::min(rect.high.x / kBlock, across - 1); ++x)
      measure(blocks_[static_cast<std::size_t>(z) * across + x]);
  }
  if (!first_) append_heights(grid_, rect, edits_);
}

std::uint16_t BruteForce::shape_of(int columns, int rows) {
  for (std::size_t i = 0; i < shapes_.size(); ++i) {
    if (shapes_[i].columns == columns && shapes_[i].rows == rows) return static_cast<std::uint16_t>(i);
  }
  Shape shape{columns, rows, static_cast<std::uint32_t>(indices_.size()), 0};
  const auto width = static_cast<std::uint32_t>(grid_.width);
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) {
      const std::uint32_t at = static_cast<std::uint32_t>(j) * width + i;
      for (const std::uint32_t vertex : {at, at + width, at + 1, at + 1, at + width, at + width + 1}) {
        indices_.push_back(vertex);
      }
    }
  }
  shape.index_count = static_cast<std::uint32_t>(indices_.size()) - shape.first_index;
  shapes_.push_back(shape);
  return static_cast<std::uint16_t>(shapes_.size() - 1);
}

const Frame& BruteForce::update(const View& view) {
  check_view(view);
  const Frustum frustum(view);
  batches_.clear();
  for (const Block& block : blocks_) {
    const Shape& shape = shapes_[block.shape];
    const float x = static_cast<float>(block.corner % grid_.width) * grid_.cell_x;
    const float z = static_cast<float>(block.corner / grid_.width) * grid_.cell_z;
    const Bounds box{{x, block.lowest, z},
                     {x + static_cast<float>(shape.columns) * grid_.cell_x, block.highest,
                      z + static_cast<float>(shape.rows) * grid_.cell_z}};
    if (frustum.see(box) == Sight::kOutside) continue;
    batches_.push_back({shape.first_index, shape.index_count, block.corner});
  }
  uploads_.assign(edits_.begin(), edits_.end());
  edits_.clear();
  if (first_) {
    uploads_.push_back(
        {.target = DirtyRange::Target::kIndices, .count = static_cast<std::uint32_t>(indices_.size())});
    uploads_.push_back(
        {.target = DirtyRange::Target::kHeights, .count = static_cast<std::uint32_t>(grid_.heights.size())});
    first_ = false;
  }
  frame_ = {.grid = grid_,
            .cell_x = grid_.cell_x,
            .cell_z = grid_.cell_z,
            .indices = indices_,
            .batches = batches_,
            .uploads = uploads_,
            .stats = count(batches_, uploads_, 0)};
  return frame_;
}

Memory BruteForce::memory() const {
  Memory memory = index_memory(blocks_, shapes_, batches_, uploads_, edits_);
  memory.index += heap_bytes(this);
  memory += payload_memory(indices_);
  return memory;
}

}  // namespace terrabench
