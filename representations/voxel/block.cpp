#include "representations/voxel/block.h"

#include <algorithm>

#include "representations/runs.h"

namespace terrabench {
namespace {

// Sets levels [begin, end) of the column at (x, z) within the block, one leaf per step. A leaf is a word per
// slice of equal x, in it a byte per column along z, in it a bit per level.
void set_levels(VoxelBlock& block, int i0, int j0, int x, int z, std::size_t begin, std::size_t end) {
  for (std::size_t level = begin; level < end;) {
    const std::size_t low = level % kLeafSide, count = std::min(kLeafSide - low, end - level);
    std::unique_ptr<VoxelLeaf>& leaf = block.leaves[level / kLeafSide];
    if (!leaf) leaf = std::make_unique<VoxelLeaf>(voxel_at(i0, j0, static_cast<int>(level - low)));
    const std::uint64_t bits = static_cast<std::uint64_t>(0xFFU >> (kLeafSide - count)) << low;
    leaf->getValueMask().getWord<openvdb::Index64>(static_cast<openvdb::Index>(x)) |= bits << (kLeafSide * z);
    level += count;
  }
}

}  // namespace

std::map<Material, VoxelBlock> sample_block(const ColumnSampler& sampler, int i0, int j0,
                                            std::vector<Material>& column) {
  const ColumnGrid& grid = sampler.grid();
  column.resize(static_cast<std::size_t>(grid.levels));
  std::map<Material, VoxelBlock> blocks;
  for (int i = i0; i < std::min(i0 + kLeafSide, grid.width); ++i) {
    for (int j = j0; j < std::min(j0 + kLeafSide, grid.depth); ++j) {
      sampler.sample(i, j, column);
      for (std::size_t begin = 0, end = 0; begin < column.size(); begin = end) {
        end = run_end(column, begin);
        if (column[begin] == Material::kAir) continue;
        VoxelBlock& block = blocks[column[begin]];
        block.leaves.resize((column.size() + kLeafSide - 1) / kLeafSide);
        set_levels(block, i0, j0, i - i0, j - j0, begin, end);
      }
    }
  }
  for (auto& [material, block] : blocks) {
    for (std::unique_ptr<VoxelLeaf>& leaf : block.leaves) {
      if (!leaf || !leaf->getValueMask().isOn()) continue;
      block.full.push_back(leaf->origin());
      leaf.reset();
    }
    std::erase(block.leaves, nullptr);
  }
  return blocks;
}

}  // namespace terrabench
