// Rolling ground with a steep edge, for the tests of grass.
#pragma once

#include <cmath>

#include "tests/renderers/ground.h"

namespace terrabench {

// side × side cells of one metre; east of the middle it is `drop` metres lower.
inline TriangleMesh meadow(int side, float drop = 6) {
  const auto middle = static_cast<float>(side) / 2;
  return testing::ground(side, static_cast<float>(side), [&](float x, float z) {
    return drop / (1 + std::exp(1.5F * (x - middle))) + 0.8F * std::sin(0.35F * x) * std::cos(0.27F * z);
  });
}

}  // namespace terrabench
