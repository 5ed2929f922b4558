// The colour ramp of heights: from deep blue-green through olive and sand to cream. Lightness increases
// throughout, so the order is kept in grey print; hue varies from blue to yellow, which most colour-blind
// readers can see.
#pragma once

#include <glm/vec3.hpp>

#include "terrain/image.h"

namespace terrabench {

// The colour at share t of the height range, clamped to 0…1, as linear-light RGB in 0…1.
glm::vec3 ramp_color(float t);

// Linear-light RGB to sRGB, both in 0…1; the nearest colour of a picture.
glm::vec3 to_srgb(const glm::vec3& linear);
Rgb srgb_bytes(const glm::vec3& linear);

// The components in 0…1, as they are.
glm::vec3 as_shares(const Rgb&);

// Linear-light sRGB in 0…1 from radiance of at least 0: as it is up to about 0.8; brighter light approaches
// white (Khronos PBR Neutral, 2024).
glm::vec3 tone_mapped(const glm::vec3& radiance);

}  // namespace terrabench
