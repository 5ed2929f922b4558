#include "lod/geomipmap/patch_tree.h"

#include <tbb/parallel_for.h>

#include <algorithm>

namespace terrabench {

PatchTree::PatchTree(const GroundGrid& grid, const PatchGrid& cut)
    : cut_(cut), cell_x_(grid.cell_x), cell_z_(grid.cell_z) {
  std::size_t nodes = 0;
  for (int across = cut.across(), down = cut.down();; across = (across + 1) / 2, down = (down + 1) / 2) {
    levels_.push_back({across, down, nodes});
    nodes += static_cast<std::size_t>(across) * down;
    if (across == 1 && down == 1) break;
  }
  nodes_.resize(nodes);
  tbb::parallel_for(std::size_t{0}, cut.count(), [&](std::size_t p) {
    const auto across = static_cast<std::size_t>(cut.across());
    const PatchGrid::Patch patch = cut.patch(static_cast<int>(p % across), static_cast<int>(p / across));
    Range range{grid.heights[static_cast<std::size_t>(patch.j0) * grid.width + patch.i0], 0};
    range.highest = range.lowest;
    for (int j = patch.j0; j <= patch.j0 + patch.rows; ++j) {
      const float* const row = &grid.heights[static_cast<std::size_t>(j) * grid.width + patch.i0];
      const auto [low, high] = std::minmax_element(row, row + patch.columns + 1);
      range = {std::min(range.lowest, *low), std::max(range.highest, *high)};
    }
    nodes_[p] = range;
  });
  for (std::size_t level = 1; level < levels_.size(); ++level) {
    const Level &here = levels_[level], &finer = levels_[level - 1];
    for (int z = 0; z < here.down; ++z) {
      for (int x = 0; x < here.across; ++x) {
        Range& range = nodes_[here.first + static_cast<std::size_t>(z) * here.across + x];
        range = nodes_[finer.first + static_cast<std::size_t>(2 * z) * finer.across + 2 * x];
        for (int below_z = 2 * z; below_z < std::min(2 * z + 2, finer.down); ++below_z) {
          for (int below_x = 2 * x; below_x < std::min(2 * x + 2, finer.across); ++below_x) {
            const Range& below =
                nodes_[finer.first + static_cast<std::size_t>(below_z) * finer.across + below_x];
            range = {std::min(range.lowest, below.lowest), std::max(range.highest, below.highest)};
          }
        }
      }
    }
  }
}

Bounds PatchTree::box(int level, int at_x, int at_z) const {
  const Level& here = levels_[static_cast<std::size_t>(level)];
  const Range& range = nodes_[here.first + static_cast<std::size_t>(at_z) * here.across + at_x];
  const int span = cut_.side << level;
  const int i1 = std::min((at_x + 1) * span, cut_.width - 1),
            j1 = std::min((at_z + 1) * span, cut_.depth - 1);
  return {
      {static_cast<float>(at_x * span) * cell_x_, range.lowest, static_cast<float>(at_z * span) * cell_z_},
      {static_cast<float>(i1) * cell_x_, range.highest, static_cast<float>(j1) * cell_z_}};
}

void PatchTree::collect(const Frustum& frustum, std::vector<Seen>& seen) const {
  collect(static_cast<int>(levels_.size()) - 1, 0, 0, false, frustum, seen);
}

void PatchTree::collect(int level, int at_x, int at_z, bool inside, const Frustum& frustum,
                        std::vector<Seen>& seen) const {
  if (!inside) {
    const Sight sight = frustum.see(box(level, at_x, at_z));
    if (sight == Sight::kOutside) return;
    inside = sight == Sight::kInside;
  }
  if (level == 0) {
    seen.push_back({cut_.slot(at_x, at_z), at_x, at_z});
    return;
  }
  const Level& finer = levels_[static_cast<std::size_t>(level - 1)];
  for (int z = 2 * at_z; z < std::min(2 * at_z + 2, finer.down); ++z) {
    for (int x = 2 * at_x; x < std::min(2 * at_x + 2, finer.across); ++x) {
      collect(level - 1, x, z, inside, frustum, seen);
    }
  }
}

Memory PatchTree::memory() const {
  Memory memory = index_memory(levels_);
  memory += index_memory(nodes_);
  return memory;
}

}  // namespace terrabench
