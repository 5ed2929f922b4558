// A height map of material stacks: the far ground of the hybrid paper (§3.5), smoother and finer than the
// stacks.
//
// The paper sums "the heights of all layers" of a column. If only layers of material count, the sum is too
// low by the air under each overhang, so that the ground sinks over caves; if the air between them counts as
// layers too, the sum is the top of the highest solid run. Both readings are here.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "representations/layered_stack/layered_stack.h"
#include "terrain/heightfield.h"

namespace terrabench {

enum class ColumnHeight : std::uint8_t { kTop, kSum };
inline constexpr std::array<std::string_view, 2> kColumnHeightNames{"top", "sum"};

// One sample per column, metres; the grid's floor where a column is empty. O(runs)
Heightfield column_heights(const LayeredStack&, ColumnHeight);

// The heights interpolated bilinearly between the columns' centres: `finer` ≥ 1 samples per column along each
// axis, the first and last on the grid's border, where the outermost columns continue. Sample (0, 0) lies at
// the grid's origin. O(samples)
Heightfield height_map(const LayeredStack&, ColumnHeight, int finer);

}  // namespace terrabench
