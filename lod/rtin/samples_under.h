// The samples of a grid under one triangle: their largest vertical distance from its plane, and their range
// of heights. O(samples), under 1 ns each in large triangles.
#pragma once

#include <array>
#include <glm/vec2.hpp>

#include "terrain/frame.h"

namespace terrabench::rtin {

struct SamplesUnder {
  double error = 0;               // metres
  float lowest = 0, highest = 0;  // metres
};

// Corners are samples, in any order; heights are finite.
SamplesUnder samples_under(const GroundGrid&, const std::array<glm::ivec2, 3>& corners);

}  // namespace terrabench::rtin
