// What methods upload that write all indices anew in each frame.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "terrain/frame.h"

namespace terrabench {

// Appends the range of the indices from the first on that differs from the last frame's. O(indices)
inline void append_changed(const std::vector<std::uint32_t>& indices, const std::vector<std::uint32_t>& last,
                           std::vector<DirtyRange>& uploads) {
  const auto same = std::ranges::mismatch(indices, last).in1;
  if (same == indices.end()) return;
  uploads.push_back({.target = DirtyRange::Target::kIndices,
                     .first = static_cast<std::uint32_t>(same - indices.begin()),
                     .count = static_cast<std::uint32_t>(indices.end() - same)});
}

}  // namespace terrabench
