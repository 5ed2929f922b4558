#include "renderers/raytrace/relief_scene.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "renderers/ramp.h"

namespace terrabench {
namespace {

constexpr glm::vec3 kRock{0.42F, 0.38F, 0.33F};
// The ramp's colours are for the picture's surface; as reflectances they would be brighter than any ground.
constexpr float kGroundShare = 0.8F;

}  // namespace

RayScene relief_scene(const TriangleMesh& mesh, float lowest, float highest) {
  RayScene scene;
  scene.background = glm::vec3(1);
  // From the left and in front of overview()'s eye, so that one side of a block is lit and the other is not,
  // and low, so that shadows show the relief.
  scene.light.sun = glm::normalize(glm::vec3(-0.85F, 0.6F, 0.35F));
  scene.light.sun_irradiance = 4.6F * sun_color(scene.light.turbidity, scene.light.sun.y);
  scene.light.sky_irradiance = 1.1F;
  const float range = std::max(highest - lowest, 1e-6F);
  scene.add_placed({.mesh = &mesh, .material_at = [lowest, range](const SurfacePoint& p) {
                      const glm::vec3 ground = kGroundShare * ramp_color((p.position.y - lowest) / range);
                      const float level = glm::smoothstep(0.25F, 0.6F, std::abs(p.normal.y));
                      return RayMaterial{.albedo = glm::mix(kRock, ground, level)};
                    }});
  return scene;
}

}  // namespace terrabench
