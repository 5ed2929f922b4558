#include "lod/fresh_frame.h"

#include <algorithm>
#include <utility>

#include "terrain/memory.h"

namespace terrabench {

void FreshFrame::begin() {
  std::swap(indices_, last_);
  indices_.clear();
}

const Frame& FreshFrame::finish(std::size_t changes) {
  const auto size = [](const auto& values) { return static_cast<std::uint32_t>(values.size()); };
  uploads_.assign(edits_.begin(), edits_.end());
  edits_.clear();
  if (const auto same = std::ranges::mismatch(indices_, last_).in1; same != indices_.end()) {
    const auto first = static_cast<std::uint32_t>(same - indices_.begin());
    uploads_.push_back(
        {.target = DirtyRange::Target::kIndices, .first = first, .count = size(indices_) - first});
  }
  if (first_) uploads_.push_back({.target = DirtyRange::Target::kHeights, .count = size(grid_.heights)});
  first_ = false;
  batches_[0] = {.index_count = size(indices_)};
  frame_ = {.grid = grid_,
            .cell_x = grid_.cell_x,
            .cell_z = grid_.cell_z,
            .indices = indices_,
            .batches = batches_,
            .uploads = uploads_,
            .stats = count(batches_, uploads_, changes)};
  return frame_;
}

void FreshFrame::edited(const SampleRect& rect) {
  check_edit(rect, grid_.width, grid_.depth);
  if (!first_) append_heights(grid_, rect, edits_);
}

Memory FreshFrame::memory() const {
  Memory memory = payload_memory(indices_, last_);
  memory += index_memory(batches_, uploads_, edits_);
  return memory;
}

}  // namespace terrabench
