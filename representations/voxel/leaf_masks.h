// Bit masks of 8 × 8 × 8 voxels, as OpenVDB's leaves hold them, sampled from a source.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <vector>

#include "representations/column_grid.h"

namespace terrabench {

inline constexpr int kLeafSide = 8;

// A word per slice of equal x, in it a byte per column along z, in it a bit per level.
using LeafMask = std::array<std::uint64_t, kLeafSide>;
// The masks over a block of 8 × 8 columns, bottom up, one list per material present (not air).
using BlockMasks = std::map<Material, std::vector<LeafMask>>;

// The block of columns from (i0, j0). `column` is scratch for one column's samples. O(samples).
BlockMasks sample_masks(const ColumnSampler&, int i0, int j0, std::vector<Material>& column);

}  // namespace terrabench
