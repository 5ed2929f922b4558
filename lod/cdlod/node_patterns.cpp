#include "lod/cdlod/node_patterns.h"

#include <algorithm>

namespace terrabench::cdlod {

NodePatterns::NodePatterns(const NodeTree& tree, int side)
    : ends_(static_cast<std::size_t>(4 * tree.levels())) {
  for (int level = 0; level < tree.levels(); ++level) {
    const PatchGrid& grid = tree.grid(level);
    std::array<bool, 4> known{};
    for (const int z : {0, grid.down() - 1}) {
      for (const int x : {0, grid.across() - 1}) {
        const PatchGrid::Patch node = grid.patch(x, z);
        const auto shape = static_cast<std::size_t>(grid.shape(node));
        if (std::exchange(known[shape], true)) continue;
        ends_[static_cast<std::size_t>(4 * level) + shape] = add(node, grid.width, side, 1 << level);
      }
    }
  }
  indices_.shrink_to_fit();
}

NodePatterns::Ends NodePatterns::add(const PatchGrid::Patch& node, int width, int side, int step) {
  const int columns = (node.columns - 1) / step + 1, rows = (node.rows - 1) / step + 1, half = side / 2;
  const auto index_of = [&](int i, int j) {
    return static_cast<std::uint32_t>(std::min(j * step, node.rows) * width +
                                      std::min(i * step, node.columns));
  };
  const auto size = [&] { return static_cast<std::uint32_t>(indices_.size()); };
  Ends ends{size()};
  for (int quarter = 0; quarter < 4; ++quarter) {
    const int i0 = (quarter & 1) * half, j0 = (quarter >> 1) * half;
    for (int j = j0; j < std::min(j0 + half, rows); ++j) {
      for (int i = i0; i < std::min(i0 + half, columns); ++i) {
        indices_.insert(indices_.end(), {index_of(i, j), index_of(i, j + 1), index_of(i + 1, j),  //
                                         index_of(i + 1, j), index_of(i, j + 1), index_of(i + 1, j + 1)});
      }
    }
    ends[static_cast<std::size_t>(quarter) + 1] = size();
  }
  return ends;
}

Memory NodePatterns::memory() const {
  Memory memory = index_memory(ends_);
  memory += payload_memory(indices_);
  return memory;
}

}  // namespace terrabench::cdlod
