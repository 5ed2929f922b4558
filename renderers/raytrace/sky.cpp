#include "renderers/raytrace/sky.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>

#include "terrain/error.h"
#include "terrain/solid.h"

namespace terrabench {
namespace {

constexpr float kPi = glm::pi<float>();
constexpr glm::vec3 kLuminance{0.2126F, 0.7152F, 0.0722F};

bool in_range(const glm::vec3& v) { return std::min({v.x, v.y, v.z}) >= 0 && is_finite(v); }

// CIE luminance and chromaticities to linear sRGB. Colours out of its gamut are cut off.
glm::vec3 from_chromaticity(const glm::vec3& v) {
  const float X = v.x * v.y / v.z, Z = v.x * (1 - v.y - v.z) / v.z;
  const glm::vec3 rgb{3.2404542F * X - 1.5371385F * v.x - 0.4985314F * Z,
                      -0.9692660F * X + 1.8760108F * v.x + 0.0415560F * Z,
                      0.0556434F * X - 0.2040259F * v.x + 1.0572252F * Z};
  return glm::max(rgb, 0.0F);
}

// Luminance and chromaticities at the zenith (Preetham et al. 1999, appendix A.2). `s`: the sun's angle from
// it.
glm::vec3 zenith_values(float t, float s) {
  const float chi = (4.0F / 9 - t / 120) * (kPi - 2 * s);
  const float s2 = s * s, s3 = s2 * s;
  return {(4.0453F * t - 4.9710F) * std::tan(chi) - 0.2155F * t + 2.4192F,
          t * t * (0.00166F * s3 - 0.00375F * s2 + 0.00209F * s) +
              t * (-0.02903F * s3 + 0.06377F * s2 - 0.03202F * s + 0.00394F) +
              (0.11693F * s3 - 0.21196F * s2 + 0.06052F * s + 0.25886F),
          t * t * (0.00275F * s3 - 0.00610F * s2 + 0.00317F * s) +
              t * (-0.04214F * s3 + 0.08970F * s2 - 0.04153F * s + 0.00516F) +
              (0.15346F * s3 - 0.26756F * s2 + 0.06670F * s + 0.26688F)};
}

}  // namespace

void check_daylight(const Daylight& light) {
  const auto refuse = [](const char* what, const char* advice) { throw bad_input(what, "daylight", advice); };
  const float length = glm::length(light.sun);
  if (!(length > 0) || !std::isfinite(length)) {
    refuse("the sun's direction is zero or not finite", "give a direction towards it");
  }
  if (!in_range(light.sun_irradiance) || !in_range(light.zenith) || !in_range(light.below) ||
      !(light.sky_irradiance >= 0) || !std::isfinite(light.sky_irradiance)) {
    refuse("a colour of light is negative or not finite", "give three values of at least 0");
  }
  if (!(light.sun_radius >= 0 && light.sun_radius <= 0.5F)) {
    refuse("the sun's radius is out of range", "it must be 0 to 0.5 radians");
  }
  if (!(light.turbidity >= 2 && light.turbidity <= 10)) {
    refuse("the turbidity is out of range", "it must be 2 to 10");
  }
}

glm::vec3 Sky::Perez::at(float cos_zenith, float cos_sun) const {
  const float angle = std::acos(std::clamp(cos_sun, -1.0F, 1.0F));
  return (1.0F + a * glm::exp(b / cos_zenith)) * (1.0F + c * glm::exp(d * angle) + e * (cos_sun * cos_sun));
}

Sky::Sky(const Daylight& light) : light_(light), sun_(glm::normalize(light.sun)) {
  if (light.sky != SkyKind::kPreetham) return;
  const float t = light.turbidity;
  perez_ = {{0.1787F * t - 1.4630F, -0.0193F * t - 0.2592F, -0.0167F * t - 0.2608F},
            {-0.3554F * t + 0.4275F, -0.0665F * t + 0.0008F, -0.0950F * t + 0.0092F},
            {-0.0227F * t + 5.3251F, -0.0004F * t + 0.2125F, -0.0079F * t + 0.2102F},
            {0.1206F * t - 2.5771F, -0.0641F * t - 0.8989F, -0.0441F * t - 1.6537F},
            {-0.0670F * t + 0.3703F, -0.0033F * t + 0.0452F, -0.0109F * t + 0.0529F}};
  // The model is made for a sun above the horizon.
  const float height = std::clamp(sun_.y, 0.02F, 1.0F);
  scale_ = zenith_values(t, std::acos(height)) / perez_.at(1, height);
  // Irradiance on level ground, by the midpoint rule over equal cosine-weighted parts of the sky.
  constexpr int kRings = 32, kParts = 64;
  double sum = 0;
  for (int r = 0; r < kRings; ++r) {
    const float radius = std::sqrt((static_cast<float>(r) + 0.5F) / kRings);
    for (int p = 0; p < kParts; ++p) {
      const float turn = 2 * kPi * (static_cast<float>(p) + 0.5F) / kParts;
      const glm::vec3 direction{radius * std::cos(turn), std::sqrt(1 - radius * radius),
                                radius * std::sin(turn)};
      sum += glm::dot(kLuminance, clear_sky(direction));
    }
  }
  const double irradiance = static_cast<double>(kPi) * sum / (kRings * kParts);
  scale_.x *= irradiance > 0 ? static_cast<float>(light.sky_irradiance / irradiance) : 0;
}

glm::vec3 Sky::clear_sky(const glm::vec3& direction) const {
  const float up = std::max(direction.y, 0.02F);  // the formula grows without bound towards the horizon
  return from_chromaticity(scale_ * perez_.at(up, glm::dot(direction, sun_)));
}

glm::vec3 Sky::radiance(const glm::vec3& direction) const {
  if (light_.sky == SkyKind::kUniform) return light_.zenith;
  if (direction.y < 0) return light_.below;
  return clear_sky(direction);
}

glm::vec3 sun_color(float turbidity, float sin_elevation) {
  const float sine = std::clamp(sin_elevation, 0.0F, 1.0F);
  const float degrees = 90 - std::asin(sine) * 180 / kPi;  // from the zenith
  const float mass = 1 / (sine + 0.15F * std::pow(93.885F - degrees, -1.253F));
  const float beta = 0.04608F * turbidity - 0.04586F;
  constexpr glm::vec3 kMicrometres{0.65F, 0.55F, 0.45F}, kOzone{0.065F, 0.085F, 0.003F};  // per cm
  glm::vec3 color;
  for (int i = 0; i < 3; ++i) {
    const float rayleigh = 0.008735F * std::pow(kMicrometres[i], -4.08F);
    const float aerosol = beta * std::pow(kMicrometres[i], -1.3F);
    color[i] = std::exp(-mass * (rayleigh + aerosol + 0.35F * kOzone[i]));
  }
  return color / std::max({color.x, color.y, color.z});
}

}  // namespace terrabench
