// Light from the sun and the sky. Radiance is in a unit in which a white diffuse surface that receives the
// irradiance π has the value 1, which the picture shows as white.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>

namespace terrabench {

enum class SkyKind : std::uint8_t {
  kUniform,   // `zenith` from all directions, from below, too
  kPreetham,  // a clear sky of the given turbidity (Preetham, Shirley & Smits 1999), and `below` from below
};

struct Daylight {
  glm::vec3 sun{-0.5F, 0.7F, 0.35F};            // towards it, of any length but zero
  glm::vec3 sun_irradiance{2.75F, 2.5F, 2.2F};  // on a surface that faces it; zero: no sun
  float sun_radius = 0.00465F;                  // radians, 0 to 0.5; half of what it spans in the sky
  SkyKind sky = SkyKind::kPreetham;
  glm::vec3 zenith{0.18F, 0.3F, 0.55F}, below{0.16F, 0.15F, 0.14F};
  float turbidity = 3;          // of kPreetham: 2 (very clear) to 10 (hazy)
  float sky_irradiance = 0.8F;  // of kPreetham: the sky's luminous irradiance on level ground
};

// Throws bad_input for values that are not finite, negative or out of the ranges above.
void check_daylight(const Daylight&);

class Sky {
 public:
  explicit Sky(const Daylight&);  // a checked one
  // From a direction of unit length, without the sun's disc. O(1).
  glm::vec3 radiance(const glm::vec3& direction) const;

 private:
  // Perez' formula for luminance and the chromaticities x and y: a value per component.
  struct Perez {
    glm::vec3 a, b, c, d, e;
    glm::vec3 at(float cos_zenith, float cos_sun) const;
  };
  glm::vec3 clear_sky(const glm::vec3& direction) const;

  Daylight light_;
  glm::vec3 sun_;
  Perez perez_{};
  glm::vec3 scale_{0};  // of Perez' formula, to luminance, x, y
};

// The sun's colour through air of this turbidity at this sine of elevation, largest component 1. From the
// transmittances of Rayleigh, aerosol and ozone at 650, 550 and 450 nm (Preetham et al. 1999, appendix A.1).
glm::vec3 sun_color(float turbidity, float sin_elevation);

}  // namespace terrabench
