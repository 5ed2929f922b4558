// The voxels of one 8 × 8 block of columns as OpenVDB holds them. Internal to representations/voxel: pulls in
// OpenVDB.
#pragma once

#include <openvdb/openvdb.h>

#include <map>
#include <memory>
#include <vector>

#include "representations/column_grid.h"

namespace terrabench {

using VoxelLeaf = openvdb::MaskTree::LeafNodeType;
inline constexpr int kLeafSide = 8;
static_assert(VoxelLeaf::DIM == kLeafSide);

// Tree coordinates: x, then z, then the level.
inline openvdb::Coord voxel_at(int i, int j, int level) { return {i, j, level}; }

// Of one material: leaves, and the 8³ tiles that are full.
struct VoxelBlock {
  std::vector<std::unique_ptr<VoxelLeaf>> leaves;
  std::vector<openvdb::Coord> full;
};

// The block of columns from (i0, j0), by material, without air. `column` is scratch for one column's samples.
// O(samples).
std::map<Material, VoxelBlock> sample_block(const ColumnSampler&, int i0, int j0,
                                            std::vector<Material>& column);

}  // namespace terrabench
