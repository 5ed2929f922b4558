// A strand of grass as the processor grows it: shaders/grass_strand.glsl once more in C++, to see how far
// what a GPU grows depends on its arithmetic (hybrid paper, §3.3).
#pragma once

#include <cstdint>
#include <glm/vec4.hpp>

#include "renderers/grass/grass.h"
#include "renderers/grass/growth.h"

namespace terrabench {

// Strand `number`, counted from 1, of the triangle with the corners (x, y, z) of a plan. In floats. O(1).
GrassStrand grow_strand(const GrassGround&, const GrassGrowth&, const glm::uvec4& triangle,
                        std::uint32_t number);

}  // namespace terrabench
