#include "renderers/landscape/shadow_cascades.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

namespace terrabench {

std::array<Cascade, kCascades> shadow_cascades(const View& view, glm::vec3 sun, const Bounds& ground,
                                               float reach, int side) {
  constexpr std::array<float, kCascades> kShares{0.05F, 0.22F, 1};
  std::array<Cascade, kCascades> cascades;
  const glm::vec3 forward = glm::normalize(view.target - view.eye);
  const glm::vec3 up = std::abs(sun.y) > 0.99F ? glm::vec3(0, 0, -1) : glm::vec3(0, 1, 0);
  const glm::mat4 to_sun = glm::lookAt(glm::vec3(0), -sun, up);
  // Along the sun's direction: from behind everything to before everything.
  float nearest = -1e30F, farthest = 1e30F;
  for (int corner = 0; corner < 8; ++corner) {
    const glm::vec3 p((corner & 1) != 0 ? ground.high.x : ground.low.x,
                      (corner & 2) != 0 ? ground.high.y : ground.low.y,
                      (corner & 4) != 0 ? ground.high.z : ground.low.z);
    const float depth = (to_sun * glm::vec4(p, 1)).z;
    nearest = std::max(nearest, depth);
    farthest = std::min(farthest, depth);
  }
  for (std::size_t k = 0; k < cascades.size(); ++k) {
    const float radius = 0.5F * reach * kShares[k];
    const glm::vec3 middle = view.eye + forward * radius * 0.9F;
    const float texel = 2 * radius / static_cast<float>(side);
    glm::vec3 at = to_sun * glm::vec4(middle, 1);
    at.x = std::floor(at.x / texel) * texel;
    at.y = std::floor(at.y / texel) * texel;
    const float margin = 0.01F * (nearest - farthest) + 1;
    cascades[k] = {glm::orthoRH_ZO(at.x - radius, at.x + radius, at.y - radius, at.y + radius,
                                   -nearest - margin, -farthest + margin) *
                       to_sun,
                   texel};
  }
  return cascades;
}

}  // namespace terrabench
