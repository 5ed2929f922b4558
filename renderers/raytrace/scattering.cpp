#include "renderers/raytrace/scattering.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>

namespace terrabench {
namespace {

constexpr float kPi = glm::pi<float>();
constexpr float kSmoothest = 0.003F;  // least alpha: below, floats lose the highlight's peak

// Smith's shadowing of one direction for GGX, times 2 cosines over them: G1 = 2c / (c + sqrt(a² + (1-a²)c²)).
float shadowing(float cosine, float alpha) {
  const float a2 = alpha * alpha;
  return 2 * cosine / (cosine + std::sqrt(a2 + (1 - a2) * cosine * cosine));
}

// Density of microfacet normals.
float facets(float cosine, float alpha) {
  const float a2 = alpha * alpha, d = cosine * cosine * (a2 - 1) + 1;
  return a2 / (kPi * d * d);
}

// A microfacet normal that is visible from `eye` (Heitz 2018).
glm::vec3 visible_facet(const glm::vec3& eye, float alpha, const glm::vec2& sample) {
  const glm::vec3 stretched = glm::normalize(glm::vec3(alpha * eye.x, alpha * eye.y, eye.z));
  const glm::vec2 disc = disc_point(sample);
  // Warps the disc to the part of the hemisphere's projection that is seen.
  const float top = std::sqrt(std::max(0.0F, 1 - disc.x * disc.x));
  const glm::vec3 across =
      stretched.z < 0.9999F ? glm::normalize(glm::cross(glm::vec3(0, 0, 1), stretched)) : glm::vec3(1, 0, 0);
  const glm::vec3 up = glm::cross(stretched, across);
  const float y = glm::mix(top, disc.y, 0.5F * (1 + stretched.z));
  const float z = std::sqrt(std::max(0.0F, 1 - disc.x * disc.x - y * y));
  const glm::vec3 normal = disc.x * across + y * up + z * stretched;
  return glm::normalize(glm::vec3(alpha * normal.x, alpha * normal.y, std::max(1e-6F, normal.z)));
}

float largest(const glm::vec3& v) { return std::max({v.x, v.y, v.z}); }

}  // namespace

UnitFrame::UnitFrame(const glm::vec3& axis) : z(axis) {
  const float sign = std::copysign(1.0F, axis.z);
  const float a = -1 / (sign + axis.z), b = axis.x * axis.y * a;
  x = {1 + sign * axis.x * axis.x * a, sign * b, -sign * axis.x};
  y = {b, sign + axis.y * axis.y * a, -axis.y};
}

glm::vec3 UnitFrame::to_local(const glm::vec3& v) const {
  return {glm::dot(v, x), glm::dot(v, y), glm::dot(v, z)};
}

glm::vec2 disc_point(const glm::vec2& sample) {
  const glm::vec2 at = 2.0F * sample - 1.0F;
  if (at.x == 0 && at.y == 0) return {0, 0};
  const bool wide = std::abs(at.x) > std::abs(at.y);
  const float radius = wide ? at.x : at.y;
  const float turn = wide ? 0.25F * kPi * (at.y / at.x) : 0.5F * kPi - 0.25F * kPi * (at.x / at.y);
  return radius * glm::vec2(std::cos(turn), std::sin(turn));
}

glm::vec3 cosine_direction(const glm::vec2& sample) {
  const glm::vec2 disc = disc_point(sample);
  return {disc.x, disc.y, std::sqrt(std::max(0.0F, 1 - glm::dot(disc, disc)))};
}

Scattering::Scattering(const RayMaterial& m, const glm::vec3& facet, const glm::vec3& normal,
                       const glm::vec3& to_eye)
    : facet_(facet),
      diffuse_((1 - m.metal) * m.albedo),
      straight_(glm::mix(glm::vec3(m.specular), m.albedo, m.metal)),
      frame_(normal),
      eye_(frame_.to_local(to_eye)),
      translucency_(m.translucency),
      alpha_(std::max(kSmoothest, m.roughness * m.roughness)),
      mirror_share_(0) {
  // An interpolated normal may turn away from the eye near silhouettes.
  eye_.z = std::max(eye_.z, 1e-3F);
  eye_ = glm::normalize(eye_);
  const float mirror = largest(straight_);
  if (mirror <= 0) return;
  const float diffuse = largest(diffuse_), seen = largest(fresnel(eye_.z));
  mirror_share_ = diffuse <= 0 ? 1 : std::clamp(seen / (seen + diffuse), 0.1F, 0.9F);
}

bool Scattering::in_front(const glm::vec3& direction) const { return glm::dot(direction, facet_) > 0; }

glm::vec3 Scattering::fresnel(float cosine) const {
  const float away = 1 - std::clamp(cosine, 0.0F, 1.0F), away2 = away * away;
  return straight_ + (1.0F - straight_) * (away2 * away2 * away);
}

glm::vec3 Scattering::mirrored(const glm::vec3& light) const {
  const glm::vec3 half = glm::normalize(light + eye_);
  return fresnel(glm::dot(half, light)) *
         (facets(half.z, alpha_) * shadowing(light.z, alpha_) * shadowing(eye_.z, alpha_) / (4 * eye_.z));
}

float Scattering::mirrored_density(const glm::vec3& light) const {
  const glm::vec3 half = glm::normalize(light + eye_);
  return facets(half.z, alpha_) * shadowing(eye_.z, alpha_) / (4 * eye_.z);
}

glm::vec3 Scattering::toward(const glm::vec3& to_light) const {
  const glm::vec3 light = frame_.to_local(to_light);
  const bool front = in_front(to_light);
  if (front != (light.z > 0)) return glm::vec3(0);  // only one of the triangle and the surface faces it
  if (!front) return diffuse_ * (translucency_ * -light.z / kPi);
  glm::vec3 diffuse = diffuse_ * ((1 - translucency_) * light.z / kPi);
  if (mirror_share_ <= 0) return diffuse;
  diffuse *= (1.0F - fresnel(light.z)) * (1.0F - fresnel(eye_.z));  // what the layer lets in and out
  return diffuse + mirrored(light);
}

bool Scattering::sample(float lobe, const glm::vec2& at, glm::vec3& direction, glm::vec3& weight) const {
  if (lobe < mirror_share_) {
    const glm::vec3 facet = visible_facet(eye_, alpha_, at);
    const glm::vec3 light = 2 * glm::dot(facet, eye_) * facet - eye_;
    if (light.z <= 0) return false;  // reflected into the surface
    direction = frame_.to_world(light);
  } else {
    const bool through = lobe - mirror_share_ < translucency_ * (1 - mirror_share_);
    glm::vec3 local = cosine_direction(at);
    if (through) local.z = -local.z;
    direction = frame_.to_world(local);
  }
  if (mirror_share_ <= 0) {
    weight = diffuse_;
    return in_front(direction) == (glm::dot(direction, frame_.z) > 0);
  }
  const glm::vec3 light = frame_.to_local(direction);
  const float share = light.z > 0 ? 1 - translucency_ : translucency_;
  float density = (1 - mirror_share_) * share * std::abs(light.z) / kPi;
  if (light.z > 0) density += mirror_share_ * mirrored_density(light);
  if (!(density > 0)) return false;
  weight = toward(direction) / density;
  return largest(weight) > 0;
}

}  // namespace terrabench
