// The sun as both path tracers see it: a disc of uniform radiance at infinite distance.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "renderers/raytrace/scattering.h"
#include "renderers/raytrace/sky.h"

namespace terrabench {

class Sun {
 public:
  explicit Sun(const Daylight&);  // a checked one

  bool shines() const { return shines_; }
  // Of unit length, towards a point of the disc; uniform over the disc for samples uniform in the unit
  // square.
  glm::vec3 direction(const glm::vec2& sample) const;
  // Of the disc in a direction of unit length; zero beside the disc, and for a disc without extent. O(1).
  glm::vec3 radiance(const glm::vec3& direction) const;

 private:
  UnitFrame frame_;  // z towards the centre of the disc
  float spread_;     // tangent of the disc's radius
  bool shines_;
  glm::vec3 irradiance_;
};

}  // namespace terrabench
