#include "representations/voxel/leaf_masks.h"

#include <algorithm>

#include "representations/runs.h"

namespace terrabench {
namespace {

// Sets levels [begin, end) of the column at (x, z) within the block, one leaf per step.
void set_levels(std::vector<LeafMask>& masks, int x, int z, std::size_t begin, std::size_t end) {
  for (std::size_t level = begin; level < end;) {
    const std::size_t low = level % kLeafSide, count = std::min(kLeafSide - low, end - level);
    const std::uint64_t bits = static_cast<std::uint64_t>(0xFFU >> (kLeafSide - count)) << low;
    masks[level / kLeafSide][static_cast<std::size_t>(x)] |= bits << (kLeafSide * z);
    level += count;
  }
}

}  // namespace

BlockMasks sample_masks(const ColumnSampler& sampler, int i0, int j0, std::vector<Material>& column) {
  const ColumnGrid& grid = sampler.grid();
  column.resize(static_cast<std::size_t>(grid.levels));
  const std::size_t leaves = (column.size() + kLeafSide - 1) / kLeafSide;
  BlockMasks block;
  for (int i = i0; i < std::min(i0 + kLeafSide, grid.width); ++i) {
    for (int j = j0; j < std::min(j0 + kLeafSide, grid.depth); ++j) {
      sampler.sample(i, j, column);
      for (std::size_t begin = 0, end = 0; begin < column.size(); begin = end) {
        end = run_end(column, begin);
        if (column[begin] == Material::kAir) continue;
        std::vector<LeafMask>& masks = block[column[begin]];
        masks.resize(leaves);
        set_levels(masks, i - i0, j - j0, begin, end);
      }
    }
  }
  return block;
}

}  // namespace terrabench
