#include "renderers/raytrace/sun.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>

namespace terrabench {

Sun::Sun(const Daylight& light)
    : frame_(glm::normalize(light.sun)),
      spread_(std::tan(light.sun_radius)),
      shines_(light.sun_irradiance != glm::vec3(0)),
      irradiance_(light.sun_irradiance) {}

glm::vec3 Sun::direction(const glm::vec2& sample) const {
  const glm::vec2 at = spread_ * disc_point(sample);
  return glm::normalize(frame_.to_world({at.x, at.y, 1}));
}

glm::vec3 Sun::radiance(const glm::vec3& direction) const {
  const float cosine = glm::dot(direction, frame_.z), spread2 = spread_ * spread_;
  const bool beside = cosine <= 0 || 1 - cosine * cosine > spread2 * cosine * cosine;
  if (!shines_ || spread2 == 0 || beside) return glm::vec3(0);
  return irradiance_ / (glm::pi<float>() * spread2);
}

}  // namespace terrabench
