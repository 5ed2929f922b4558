#include "renderers/landscape/scene_block.h"

#include <cmath>

namespace terrabench {

SceneBlock describe(const LandscapeStyle& s, double seconds) {
  SceneBlock b;
  b.sun = glm::vec4(s.sun, s.fog_sun_exponent);
  b.sun_light = glm::vec4(s.sun_light, s.fog_sun);
  b.sky_light = glm::vec4(s.sky_light, s.occlusion);
  b.sky_high = glm::vec4(s.sky_high, s.sky_falloff);
  b.sky_low = glm::vec4(s.sky_low, s.haze);
  b.fog_color = glm::vec4(s.fog_color, s.fog_distance);
  // Reduced to one period here, so that a float in the shader stays precise after days.
  const double turns = seconds * s.cloud_speed;
  b.cloud_color = glm::vec4(s.cloud_color, turns - std::floor(turns));
  b.cloud_range = glm::vec4(s.cloud_range, s.cloud_shading, 0);
  b.border = glm::vec4(s.ground.low.x, s.ground.low.z, s.ground.high.x, s.ground.high.z);
  b.border_fade = glm::vec4(s.border_width, s.border_distance, 0);
  b.band_tops = glm::vec4(s.band_tops[0], s.band_tops[1], s.band_tops[2], s.band_tops[3]);
  b.ground = glm::vec4(s.band_blend, s.steep, s.steep_blend, s.texture_width);
  b.ground_modes =
      glm::vec4(s.slope_as_printed ? 1 : 0, s.triplanar ? 1 : 0, s.bumps, s.occlusion > 0 ? 0 : 1);
  for (std::size_t k = 0; k < kMaterials; ++k) {
    b.materials[2 * k] = glm::vec4(s.materials[k].dark, 0);
    b.materials[2 * k + 1] = glm::vec4(s.materials[k].light, 0);
  }
  b.water = glm::vec4(s.water_level, 0, 0, s.wave_width);
  b.water_color = glm::vec4(s.water_color, s.clarity);
  b.waves = glm::vec4(s.distortion, s.wave_slope, static_cast<float>(s.wave_speed * seconds), s.highlight);
  b.fresnel =
      glm::vec4(static_cast<float>(s.fresnel), s.fresnel_normal, s.fresnel_power, s.highlight_exponent);
  return b;
}

}  // namespace terrabench
