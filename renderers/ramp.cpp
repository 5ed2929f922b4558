#include "renderers/ramp.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <iterator>

namespace terrabench {
namespace {

// Lightness L and the axes a (green-red) and b (blue-yellow) of Oklab (Ottosson 2020), a perceptually uniform
// space. Steps in lightness are equal; hues were chosen by eye on printed relief.
constexpr glm::vec3 kStops[] = {
    {0.49F, -0.045F, -0.035F}, {0.58F, -0.052F, 0.008F}, {0.67F, -0.042F, 0.048F},
    {0.76F, -0.012F, 0.068F},  {0.85F, 0.012F, 0.062F},  {0.94F, 0.006F, 0.030F},
};

glm::vec3 from_oklab(const glm::vec3& lab) {
  const float l = lab.x + 0.3963377774F * lab.y + 0.2158037573F * lab.z;
  const float m = lab.x - 0.1055613458F * lab.y - 0.0638541728F * lab.z;
  const float s = lab.x - 0.0894841775F * lab.y - 1.2914855480F * lab.z;
  const float l3 = l * l * l, m3 = m * m * m, s3 = s * s * s;
  return {4.0767416621F * l3 - 3.3077115913F * m3 + 0.2309699292F * s3,
          -1.2684380046F * l3 + 2.6097574011F * m3 - 0.3413193965F * s3,
          -0.0041960863F * l3 - 0.7034186147F * m3 + 1.7076147010F * s3};
}

}  // namespace

glm::vec3 ramp_color(float t) {
  constexpr auto kLast = static_cast<float>(std::size(kStops) - 1);
  const float at = std::clamp(t, 0.0F, 1.0F) * kLast;
  const float stop = std::min(std::floor(at), kLast - 1);
  const auto i = static_cast<std::size_t>(stop);
  return glm::clamp(from_oklab(glm::mix(kStops[i], kStops[i + 1], at - stop)), 0.0F, 1.0F);
}

glm::vec3 to_srgb(const glm::vec3& linear) {
  glm::vec3 encoded;
  for (int i = 0; i < 3; ++i) {
    encoded[i] =
        linear[i] <= 0.0031308F ? 12.92F * linear[i] : 1.055F * std::pow(linear[i], 1 / 2.4F) - 0.055F;
  }
  return encoded;
}

glm::vec3 as_shares(const Rgb& color) { return glm::vec3(color[0], color[1], color[2]) / 255.0F; }

Rgb srgb_bytes(const glm::vec3& linear) {
  const glm::vec3 bytes = glm::floor(to_srgb(linear) * 255.0F + 0.5F);
  return {static_cast<std::uint8_t>(bytes.x), static_cast<std::uint8_t>(bytes.y),
          static_cast<std::uint8_t>(bytes.z)};
}

glm::vec3 tone_mapped(const glm::vec3& color) {
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
