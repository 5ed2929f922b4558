// From radiance to the colours of a picture.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>

namespace terrabench {

enum class ToneCurve : std::uint8_t {
  kLinear,   // as it is; above 1 it is cut off
  kNeutral,  // as it is up to about 0.8; brighter light approaches white (Khronos PBR Neutral, 2024)
};

struct ToneMapping {
  ToneCurve curve = ToneCurve::kNeutral;
};

// Linear-light sRGB in 0 to 1 from radiance of at least 0. O(1)
glm::vec3 tone_mapped(const glm::vec3& radiance, const ToneMapping&);

}  // namespace terrabench
