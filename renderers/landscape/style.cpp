#include "renderers/landscape/style.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <string>

#include "terrain/error.h"

namespace terrabench {
namespace {

constexpr std::array<std::string_view, 2> kSlopeRules{"true", "printed"};
constexpr std::array<std::string_view, 3> kReadings{"view", "reflected", "light"};

ParameterSpec number(std::string_view name, double fallback, std::string_view unit, std::string_view help,
                     double lowest, double highest) {
  return {name, fallback, unit, help, lowest, highest};
}
ParameterSpec share(std::string_view name, double fallback, std::string_view help) {
  return number(name, fallback, "", help, 0, 1);
}
ParameterSpec flag(std::string_view name, bool fallback, std::string_view help) {
  return {name, fallback, "", help};
}
ParameterSpec colour(std::string_view name, const char* fallback, std::string_view help) {
  return {name, std::string(fallback), "", help};
}

const ParameterSpec kSpecs[] = {
    number("sun_azimuth", 235, "°", "direction of the sun, clockwise from north", -360, 360),
    number("sun_height", 24, "°", "height of the sun above the horizon", -10, 90),
    colour("sun_color", "#fff0d8", "colour of sunlight, #rrggbb"),
    number("sun_strength", 2.1, "", "brightness of sunlight", 0, 100),
    number("sky_strength", 1.0, "", "brightness of the light from the sky", 0, 100),
    flag("shadows", true, "cast shadows"),
    number("occlusion", 0.8, "", "strength of ambient occlusion; 0 switches it off", 0, 4),
    number("occlusion_radius", 0.05, "", "how far occlusion reaches, as a share of the distance", 0.001, 0.5),

    colour("sky_high", "#3d72b8", "colour of the sky overhead, #rrggbb"),
    colour("sky_low", "#b4d0e8", "colour of the sky near the horizon, #rrggbb"),
    colour("cloud_color", "#f4f4f2", "colour of clouds, #rrggbb"),
    share("cloud_cover", 0.45, "how much of the sky has clouds"),
    number("cloud_softness", 0.6, "", "width of the clouds' edges, in units of the noise", 0.01, 2),
    share("cloud_shading", 1,
          "how much clouds are shaded by their thickness and the sun; 0: one colour, as in the "
          "paper"),
    number("cloud_size", 1, "", "size of clouds", 0.05, 20),
    number("cloud_speed", 1.0 / 900, "1/s", "turns of the sky's dome per second", -1, 1),
    number("haze", 0.16, "", "height up to which fog covers the sky, the sine of its angle", 0.001, 1),

    colour("fog_color", "#c6d4e0", "colour of the fog, #rrggbb"),
    number("fog", 0.55, "",
           "distance at which fog leaves 1/e of the ground's colour, as a share of the extent", 0.001, 1000),
    number("fog_sun", 0.6, "", "strength of the sun's colour in the fog", 0, 1),
    number("fog_sun_exponent", 9, "", "the higher, the smaller the part of the fog that the sun colours", 0.1,
           1000),
    number("border", 0.12, "",
           "width over which the ground's border blends into the sky, share of the extent", 0, 0.5),

    share("sand_top", 0.03, "height up to which sand lies, as a share of the relief above the water"),
    share("grass_top", 0.45, "height up to which grass grows, likewise"),
    share("earth_top", 0.62, "height up to which earth lies, likewise"),
    share("rock_top", 0.86, "height up to which rock lies, likewise; snow above"),
    share("band_blend", 0.06, "height over which two bands blend, likewise"),
    choice("slope_rule", kSlopeRules, "the angle of ground: true, acos(n_y), or as printed, (1 - n_y)·90°"),
    number("steep", 38, "°", "angle from which ground is rock", 0, 180),
    number("steep_blend", 7, "°", "half the angle over which ground blends to rock", 0.01, 90),
    number("texture", 6, "m", "width of a texture; repeated wider with the distance", 0.001, 1e6),
    flag("triplanar", true,
         "texture ground along three axes; otherwise along y alone, as in the paper, whose textures "
         "are stretched on steep ground"),
    number("bumps", 1, "", "strength of the textures' bumps", 0, 10),
    colour("sand_color", "#b49a6e", "colour of sand, #rrggbb; darker and lighter shades derive from it"),
    colour("grass_color", "#545c36", "colour of grass, likewise"),
    colour("earth_color", "#6f5a40", "colour of earth, likewise"),
    colour("rock_color", "#7c7770", "colour of rock, likewise"),
    colour("snow_color", "#e9eef4", "colour of snow, likewise"),

    share("water", 0.22, "level of the water, as a share of the ground's relief; 0: no water"),
    choice("fresnel", kReadings,
           "vector whose product with the water's normal gives the reflectance: view, the reflected line of "
           "sight, or the sun's light reflected by the water, as printed"),
    share("fresnel_normal", 0.02, "reflectance of water seen along its normal"),
    number("fresnel_power", 5, "", "exponent of the Fresnel term", 0.1, 20),
    colour("water_color", "#0f3a44", "colour of deep water, #rrggbb"),
    number("clarity", 5, "m", "distance over which water absorbs light to the share 1/e", 0.001, 1e6),
    number("wave_width", 7, "m", "width of the waves' texture; wider with the distance", 0.001, 1e6),
    number("wave_slope", 1, "", "steepness of waves; 0: no normal map", 0, 10),
    number("wave_speed", 0.15, "1/s", "speed of waves, in widths of their texture per second", 0, 100),
    number("distortion", 0.02, "", "how far waves warp reflections, as a share of the picture", 0, 1),
    number("highlight", 1.2, "", "strength of the sun's highlights on water", 0, 100),
    number("highlight_exponent", 260, "", "the higher, the smaller the highlights", 1, 10000),
    {"texture_seed", std::int64_t{1}, "", "seed of clouds, waves and ground textures", 0, 1e9},
};

glm::vec3 to_linear(glm::vec3 srgb) {
  const auto one = [](float c) { return c <= 0.04045F ? c / 12.92F : std::pow((c + 0.055F) / 1.055F, 2.4F); };
  return {one(srgb.r), one(srgb.g), one(srgb.b)};
}

glm::vec3 colour_of(const Parameters& p, std::string_view name) {
  const std::string& text = p.text(name);
  unsigned r = 0, g = 0, b = 0;
  char rest = 0;
  const bool digits = text.size() == 7 && text.find_first_not_of("0123456789abcdefABCDEF", 1) == text.npos;
  if (!digits || std::sscanf(text.c_str(), "#%2x%2x%2x%c", &r, &g, &b, &rest) != 3) {
    throw usage_error(fmt::format("invalid colour '{}' for '{}'", text, name), "--set",
                      "write it as #rrggbb, such as #3d72b8");
  }
  return to_linear(glm::vec3(r, g, b) / 255.0F);
}

float number_of(const Parameters& p, std::string_view name) { return static_cast<float>(p.number(name)); }

void set_sky(LandscapeStyle& style, const Parameters& p) {
  const float azimuth = glm::radians(number_of(p, "sun_azimuth"));
  const float height = glm::radians(number_of(p, "sun_height"));
  style.sun = {std::cos(height) * std::sin(azimuth), std::sin(height), -std::cos(height) * std::cos(azimuth)};
  // Reddened and weakened near the horizon, and gone below it.
  const float low = 1 - glm::smoothstep(0.0F, 0.45F, style.sun.y),
              above = glm::smoothstep(-0.04F, 0.02F, style.sun.y);
  style.sun_light = number_of(p, "sun_strength") * colour_of(p, "sun_color") * above *
                    glm::mix(glm::vec3(1), glm::vec3(1.0F, 0.72F, 0.42F), low);
  style.sky_high = colour_of(p, "sky_high");
  style.sky_low = colour_of(p, "sky_low");
  style.sky_light = number_of(p, "sky_strength") * glm::mix(style.sky_low, style.sky_high, 0.4F);
  style.cloud_color = colour_of(p, "cloud_color");
  // The noise map is equalised to 0…1, so that its value is the share of the sky below it.
  const float clear = 1 - number_of(p, "cloud_cover");
  style.cloud_range = {clear - 0.25F * number_of(p, "cloud_softness"),
                       clear + 0.75F * number_of(p, "cloud_softness")};
  style.cloud_shading = number_of(p, "cloud_shading");
  style.cloud_size = number_of(p, "cloud_size");
  style.cloud_speed = number_of(p, "cloud_speed");
  style.haze = number_of(p, "haze");
  style.shadows = p.flag("shadows") && style.sun.y > 0;
  style.occlusion = number_of(p, "occlusion");
  style.occlusion_radius = number_of(p, "occlusion_radius");
}

void set_materials(LandscapeStyle& style, const Parameters& p, float base, float relief) {
  constexpr std::array<std::string_view, 4> kBands{"sand_top", "grass_top", "earth_top", "rock_top"};
  float below = base;
  for (std::size_t band = 0; band < kBands.size(); ++band) {
    below = std::max(below, base + relief * number_of(p, kBands[band]));
    style.band_tops[band] = below;
  }
  style.band_blend = std::max(relief * number_of(p, "band_blend"), 1e-3F);
  style.slope_as_printed = p.choice("slope_rule") == 1;
  style.steep = number_of(p, "steep");
  style.steep_blend = number_of(p, "steep_blend");
  style.triplanar = p.flag("triplanar");
  style.bumps = number_of(p, "bumps");
  constexpr std::array<std::string_view, kMaterials> kColors{"sand_color", "grass_color", "earth_color",
                                                             "rock_color", "snow_color"};
  // Dark shades tend to the material's neighbours in nature: wet sand, deep green, shadowed snow.
  const std::array<MaterialColors, kMaterials> kShades{{{{0.62F, 0.60F, 0.58F}, {1.25F, 1.24F, 1.2F}},
                                                        {{0.50F, 0.62F, 0.55F}, {1.4F, 1.22F, 1.1F}},
                                                        {{0.55F, 0.55F, 0.56F}, {1.5F, 1.45F, 1.35F}},
                                                        {{0.42F, 0.43F, 0.46F}, {1.55F, 1.5F, 1.42F}},
                                                        {{0.86F, 0.9F, 0.96F}, {1.08F, 1.06F, 1.04F}}}};
  for (std::size_t k = 0; k < kMaterials; ++k) {
    const glm::vec3 colour = colour_of(p, kColors[k]);
    style.materials[k] = {colour * kShades[k].dark, glm::min(colour * kShades[k].light, glm::vec3(0.95F))};
  }
}

void set_water(LandscapeStyle& style, const Parameters& p) {
  style.fresnel = static_cast<FresnelReading>(p.choice("fresnel"));
  style.fresnel_normal = number_of(p, "fresnel_normal");
  style.fresnel_power = number_of(p, "fresnel_power");
  style.water_color = colour_of(p, "water_color");
  style.clarity = number_of(p, "clarity");
  style.wave_width = number_of(p, "wave_width");
  style.wave_slope = number_of(p, "wave_slope");
  style.wave_speed = style.wave_width * number_of(p, "wave_speed");
  style.distortion = number_of(p, "distortion");
  style.highlight = number_of(p, "highlight");
  style.highlight_exponent = number_of(p, "highlight_exponent");
}

}  // namespace

std::span<const ParameterSpec> landscape_parameters() { return kSpecs; }

LandscapeStyle make_style(const Parameters& p, const Bounds& ground) {
  LandscapeStyle style;
  style.ground = ground;
  style.seed = static_cast<std::uint64_t>(p.integer("texture_seed"));
  const glm::vec3 size = ground.size();
  const float extent = std::max({size.x, size.z, 1e-3F});
  const float water = number_of(p, "water");
  style.has_water = water > 0;
  style.water_level = ground.low.y + water * size.y;
  const float base = style.has_water ? style.water_level : ground.low.y;
  set_sky(style, p);
  set_materials(style, p, base, ground.high.y - base);
  set_water(style, p);
  style.texture_width = number_of(p, "texture");
  style.fog_color = colour_of(p, "fog_color");
  style.fog_distance = extent * number_of(p, "fog");
  style.fog_sun = number_of(p, "fog_sun");
  style.fog_sun_exponent = number_of(p, "fog_sun_exponent");
  style.border_width = extent * number_of(p, "border");
  style.border_distance = {0.5F * style.border_width, 2 * style.border_width};
  return style;
}

void thin_fog(LandscapeStyle& style, const glm::vec3& eye) {
  const glm::vec3 nearest = glm::clamp(eye, style.ground.low, style.ground.high);
  style.fog_distance = std::max(style.fog_distance, 2.5F * glm::distance(eye, nearest));
}

}  // namespace terrabench
