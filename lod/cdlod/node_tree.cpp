#include "lod/cdlod/node_tree.h"

#include <tbb/parallel_for.h>

#include <algorithm>

namespace terrabench::cdlod {

int levels_of(int width, int depth, int side, int largest) {
  int levels = 1;
  while (side << levels <= largest && side << (levels - 1) < std::max(width, depth) - 1) ++levels;
  return levels;
}

NodeTree::NodeTree(int width, int depth, glm::vec2 cell, int side, int levels)
    : cell_x_(cell.x), cell_z_(cell.y) {
  std::size_t nodes = 0;
  for (int level = 0; level < levels; ++level) {
    grids_.push_back({width, depth, side << level});
    firsts_.push_back(nodes);
    nodes += grids_.back().count();
  }
  ranges_.resize(nodes);
}

NodeTree::NodeTree(const GroundGrid& grid, int side, int levels)
    : NodeTree(grid.width, grid.depth, {grid.cell_x, grid.cell_z}, side, levels) {
  measure(grid, {{0, 0}, {grid.width - 1, grid.depth - 1}});
}

NodeTree::Range NodeTree::measured(const GroundGrid& grid, const PatchGrid::Patch& leaf) const {
  Range range{grid.heights[static_cast<std::size_t>(leaf.j0) * grid.width + leaf.i0], 0};
  range.highest = range.lowest;
  for (int j = leaf.j0; j <= leaf.j0 + leaf.rows; ++j) {
    const float* const row = &grid.heights[static_cast<std::size_t>(j) * grid.width + leaf.i0];
    const auto [low, high] = std::minmax_element(row, row + leaf.columns + 1);
    range = {std::min(range.lowest, *low), std::max(range.highest, *high)};
  }
  return range;
}

void NodeTree::measure(const GroundGrid& grid, const SampleRect& rect) {
  const PatchGrid::PatchRect leaves = this->grid(0).holding(rect.low, rect.high);
  tbb::parallel_for(leaves.z0, leaves.z1 + 1, [&](int z) {
    for (int x = leaves.x0; x <= leaves.x1; ++x) {
      ranges_[number(0, x, z)] = measured(grid, this->grid(0).patch(x, z));
    }
  });
  for (int level = 1; level < levels(); ++level) {
    for (int z = leaves.z0 >> level; z <= leaves.z1 >> level; ++z) {
      for (int x = leaves.x0 >> level; x <= leaves.x1 >> level; ++x) {
        Range all = ranges_[number(level - 1, 2 * x, 2 * z)];
        for (const auto& [dx, dz] : {std::pair{1, 0}, {0, 1}, {1, 1}}) {
          if (!has(level - 1, 2 * x + dx, 2 * z + dz)) continue;
          const Range& child = ranges_[number(level - 1, 2 * x + dx, 2 * z + dz)];
          all = {std::min(all.lowest, child.lowest), std::max(all.highest, child.highest)};
        }
        ranges_[number(level, x, z)] = all;
      }
    }
  }
}

Bounds NodeTree::box(int level, int x, int z) const {
  const PatchGrid::Patch node = grid(level).patch(x, z);
  const Range& range = ranges_[number(level, x, z)];
  return {{static_cast<float>(node.i0) * cell_x_, range.lowest, static_cast<float>(node.j0) * cell_z_},
          {static_cast<float>(node.i0 + node.columns) * cell_x_, range.highest,
           static_cast<float>(node.j0 + node.rows) * cell_z_}};
}

}  // namespace terrabench::cdlod
