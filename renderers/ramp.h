// The colour ramp of heights: from deep blue-green through olive and sand to cream. Lightness increases
// throughout, so the order is kept in grey print; hue varies from blue to yellow, which most colour-blind
// readers can see.
#pragma once

#include <glm/vec3.hpp>

namespace terrabench {

// The colour at share t of the height range, clamped to 0…1, as linear-light RGB in 0…1.
glm::vec3 ramp_color(float t);

// Linear-light RGB to sRGB, both in 0…1.
glm::vec3 to_srgb(const glm::vec3& linear);

}  // namespace terrabench
