// One-dimensional midpoint displacement (Alonso et al., §2.3.1): a line is broken at its middle, the middle
// moves up or down at random, and both halves are broken again with a smaller range. O(points).
#pragma once

#include <cstdint>
#include <vector>

namespace terrabench::fractal {

struct MidpointOptions {
  std::uint64_t seed = 1;
  int levels = 8;             // 2^levels + 1 points; 0 to 24
  float amplitude = 1;        // metres, the largest displacement of the first middle
  float hurst = 1;            // each level's range is 2^-hurst of the one before; 0 to 1, smoother upward
  float left = 0, right = 0;  // metres, the ends
};

// The points from left to right, equally spaced. Every level keeps the points of the level before: fewer
// levels give the same line with fewer points. Throws usage_error.
std::vector<float> midpoint_displacement(const MidpointOptions&);

}  // namespace terrabench::fractal
