// How a landscape looks: light, sky, fog, materials and water, as parameters with units, ranges and help.
// Terrains differ in size by a factor of a thousand, so heights are given as shares of the ground's relief
// and distances as shares of its extent; make_style() turns them into metres.
//
// Hybrid paper: materials §4.1, fog §4.2, sky §4.3, blending into the sky §4.4, water §3.4. Where it leaves a
// choice, both readings are parameters: `slope_rule` and `fresnel`.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>

#include "terrain/parameters.h"
#include "terrain/solid.h"

namespace terrabench {

// The vector whose product with the water's normal gives the Fresnel term; numbered as in fresnel.glsl.
enum class FresnelReading : std::uint8_t {
  kView,       // towards the eye
  kReflected,  // where the light that the water reflects to the eye comes from
  kLight       // the sun's light reflected by the water, as printed
};

// A material's colours vary between two.
struct MaterialColors {
  glm::vec3 dark, light;  // linear light
};
inline constexpr int kMaterials = 5;  // sand, grass, earth, rock, snow

// Lengths in metres, colours in linear light, angles in degrees unless a name says otherwise.
struct LandscapeStyle {
  Bounds ground;  // blends into the sky at its border in plan

  glm::vec3 sun{0, 1, 0};  // unit vector towards the sun
  glm::vec3 sun_light{1}, sky_light{1};
  bool shadows = true;
  float occlusion = 1, occlusion_radius = 0.05F;  // strength; share of the distance from the eye

  glm::vec3 sky_high{0}, sky_low{0}, cloud_color{1};
  float sky_falloff = 4, haze = 0.2F;     // the fog covers the sky up to this height, the sine of an angle
  glm::vec2 cloud_range{0, 1};            // values of the noise map without cloud and with full cloud
  float cloud_shading = 1;                // 0: clouds of one colour, as in the paper
  float cloud_size = 1, cloud_speed = 0;  // turns of the dome per second
  std::uint64_t seed = 1;                 // of all textures

  glm::vec3 fog_color{1};
  float fog_distance = 1000;  // where the ground keeps the share 1/e of its colour
  float fog_sun = 1, fog_sun_exponent = 8;
  float border_width = 0;        // of the ground's blend into the sky
  glm::vec2 border_distance{0};  // from the eye: nearer than the first, nothing blends

  std::array<float, 4> band_tops{};  // heights up to which sand, grass, earth and rock lie
  float band_blend = 1;
  bool slope_as_printed = false;
  float steep = 40, steep_blend = 8;
  float texture_width = 8;
  bool triplanar = true;
  float bumps = 1;
  std::array<MaterialColors, kMaterials> materials{};

  bool has_water = false;
  float water_level = 0;
  FresnelReading fresnel = FresnelReading::kView;
  float fresnel_normal = 0.02F, fresnel_power = 5;  // reflectance at normal view
  glm::vec3 water_color{0};
  float clarity = 4;  // light that has passed this far through water keeps the share 1/e
  float wave_width = 6, wave_slope = 1, wave_speed = 1, distortion = 0.02F;  // m, factor, m/s, of the picture
  float highlight = 1, highlight_exponent = 200;
};

std::span<const ParameterSpec> landscape_parameters();

// The style for ground within these bounds, which may be flat. Throws usage_error for a colour that is not
// written as #rrggbb.
LandscapeStyle make_style(const Parameters&, const Bounds& ground);

// An eye far outside the ground, such as that of a plan, would see nothing but fog: the nearest ground keeps
// at least 85 % of its colour.
void thin_fog(LandscapeStyle&, const glm::vec3& eye);

}  // namespace terrabench
