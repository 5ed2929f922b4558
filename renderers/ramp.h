// The colours of heights: from deep blue-green through olive and sand to cream. Lightness rises all the way,
// and the hue runs along blue-yellow, which most colour-blind readers see too; in grey print the order stays.
#pragma once

#include <glm/vec3.hpp>

namespace terrabench {

// The colour at t of the way up, 0…1 (clamped), as linear-light RGB in 0…1.
glm::vec3 ramp_color(float t);

// From linear light to the sRGB values that pictures hold, 0…1.
glm::vec3 to_srgb(const glm::vec3& linear);

}  // namespace terrabench
