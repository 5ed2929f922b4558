// The heights of stacks' columns in one array, for sampling the field at single points: a sample with the
// cube kernel reads some 25 columns, and from here each costs one load, where it is one solid stretch from
// the floor up. 2 B per column.
#pragma once

#include <cstdint>
#include <vector>

#include "representations/layered_stack/layered_stack.h"
#include "terrain/memory.h"

namespace terrabench {

class ColumnTops {
 public:
  static constexpr std::uint16_t kOther = 0xFFFF;  // not one stretch, or as high: ask the stack

  // Does not follow later edits. O(runs)
  explicit ColumnTops(const LayeredStack& stack) : width_(static_cast<std::size_t>(stack.grid().width)) {
    tops_.reserve(stack.grid().columns());
    for (int j = 0; j < stack.grid().depth; ++j) {
      for (int i = 0; i < stack.grid().width; ++i) tops_.push_back(top(stack.column(i, j)));
    }
  }

  // In levels.
  const std::uint16_t* row(int j) const { return tops_.data() + static_cast<std::size_t>(j) * width_; }
  std::size_t bytes() const { return heap_bytes(tops_.data()); }

 private:
  static std::uint16_t top(const ColumnRuns& runs) {
    std::size_t solid = 0;
    while (solid < runs.count && runs.materials[solid] != Material::kAir) ++solid;
    for (std::size_t r = solid; r < runs.count; ++r) {
      if (runs.materials[r] != Material::kAir) return kOther;
    }
    return solid == 0 ? kOther : runs.tops[solid - 1];
  }

  std::size_t width_;
  std::vector<std::uint16_t> tops_;
};

}  // namespace terrabench
