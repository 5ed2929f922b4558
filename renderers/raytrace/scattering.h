// How a surface scatters light: diffuse to both sides (Lambert) under a mirroring layer of microfacets (GGX;
// Walter et al. 2007) with Schlick's Fresnel term.
#pragma once

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "renderers/raytrace/ray_scene.h"

namespace terrabench {

// Least roughness of what is seen by reflection. Light that a smooth mirror concentrates would be found by
// few of the paths, as bright specks (Kaplanyan & Dachsbacher 2013).
inline constexpr float kIndirectRoughness = 0.6F;

// A position computed on a triangle is off by a few units in the last place of its coordinates; 64 of them
// keep a ray that starts there from hitting the triangle itself.
inline constexpr float kRayOffset = 64 * 0x1p-23F;

inline glm::vec3 unit_or(const glm::vec3& v, const glm::vec3& otherwise) {
  const float length = glm::length(v);
  return length > 0 && std::isfinite(length) ? v / length : otherwise;
}

// A right-handed frame around a unit vector (Duff et al. 2017).
struct UnitFrame {
  glm::vec3 x, y, z;
  explicit UnitFrame(const glm::vec3& axis);
  glm::vec3 to_world(const glm::vec3& v) const { return v.x * x + v.y * y + v.z * z; }
  glm::vec3 to_local(const glm::vec3& v) const;
};

// Directions around +z with density proportional to cosine.
glm::vec3 cosine_direction(const glm::vec2& sample);
// The unit disc, uniformly (Shirley & Chiu 1997).
glm::vec2 disc_point(const glm::vec2& sample);

class Scattering {
 public:
  // All of unit length; `facet`, the triangle's own normal, and `normal` are on the eye's side.
  Scattering(const RayMaterial&, const glm::vec3& facet, const glm::vec3& normal, const glm::vec3& to_eye);

  // Radiance towards the eye per radiance from `to_light` and solid angle: the scattering function times the
  // cosine.
  glm::vec3 toward(const glm::vec3& to_light) const;

  // Whether sample() reads `lobe`.
  bool has_lobes() const { return mirror_share_ > 0 || translucency_ > 0; }

  // Chooses a direction from which light may come; `weight` is toward() divided by the direction's density.
  // False if no light comes from it. Of a diffuse material, the weight is exactly its albedo.
  bool sample(float lobe, const glm::vec2&, glm::vec3& direction, glm::vec3& weight) const;

  // Whether the direction lies on the eye's side of the triangle.
  bool in_front(const glm::vec3& direction) const;

 private:
  glm::vec3 fresnel(float cosine) const;
  glm::vec3 mirrored(const glm::vec3& light) const;  // toward() of the microfacets, in the local frame
  float mirrored_density(const glm::vec3& light) const;

  glm::vec3 facet_, diffuse_, straight_;  // straight_: the mirrored share straight from the front
  UnitFrame frame_;
  glm::vec3 eye_;  // in the frame
  float translucency_, alpha_;
  float mirror_share_;  // probability of sampling the mirroring layer; 0: there is none
};

}  // namespace terrabench
