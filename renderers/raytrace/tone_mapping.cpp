#include "renderers/raytrace/tone_mapping.h"

#include <algorithm>
#include <glm/common.hpp>

namespace terrabench {

glm::vec3 tone_mapped(const glm::vec3& radiance, const ToneMapping& mapping) {
  const glm::vec3 color = radiance;
  if (mapping.curve == ToneCurve::kLinear) return glm::clamp(color, 0.0F, 1.0F);
  // The published curve also subtracts the mirrored light of paint from dark colours, which terrain lacks.
  constexpr float kStart = 0.8F, kDesaturation = 0.15F;
  const float peak = std::max({color.x, color.y, color.z});
  if (peak < kStart) return color;
  constexpr float kRange = 1 - kStart;
  const float bright = 1 - kRange * kRange / (peak + kRange - kStart);
  const float white = 1 - 1 / (kDesaturation * (peak - bright) + 1);
  return glm::clamp(glm::mix(color * (bright / peak), glm::vec3(bright), white), 0.0F, 1.0F);
}

}  // namespace terrabench
