// Evaluates functions of the landscape's shaders on numbers, so that a claim about a formula is measured on
// what the GPU computes.
#pragma once

#include <glm/vec4.hpp>
#include <span>
#include <vector>

#include "renderers/context.h"

namespace terrabench {

enum class Probe : std::uint8_t {
  kSkyShare,     // sky_blend.glsl: of intensity x
  kReflectance,  // fresnel.glsl: x the eye's angle from the water's normal, y the sun's height, z the angle
                 // between their directions in plan (radians), w the reading; at normal view 0.02, power 5
  kSlope         // ground_slope.glsl, degrees: of y of the normal, x; as printed if y is 1
};

// The function's value for each input, at most 16384 of them.
std::vector<float> evaluate(GlContext&, Probe, std::span<const glm::vec4> inputs);

}  // namespace terrabench
