// The two-dimensional scene of the MRBSP paper's figure 2 and table 1: a profile of heights, a binary tree of
// its segments, coarse segments for visibility, and cells along it; the sampled visibility of visibility.h
// with one dimension less. O(cells × segments²).
#pragma once

#include <span>
#include <vector>

#include "lod/mrbsp/visibility.h"

namespace terrabench {

struct ProfileScene {
  std::vector<float> heights;  // 2^depth + 1, one apart
  int depth = 4;               // of the finest segments
  int coarse_depth = 2;        // of the segments that block and are blocked
  int cells = 8;               // of equal width; a power of two
  float eye_height = 0;        // above the ground
};

// A profile whose changes are exactly the lines of table 1.
const ProfileScene& table1_profile();

// The observer is tried at two places a cell. Throws usage_error when the numbers do not fit each other.
VisibleSets find_visible(const ProfileScene&);

}  // namespace terrabench
