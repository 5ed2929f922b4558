// A ray: part of a half-line in space.
#pragma once

#include <glm/vec3.hpp>
#include <limits>

namespace terrabench {

struct Ray {
  glm::vec3 origin{0};     // metres
  glm::vec3 direction{0};  // of any length but zero; distances are in its lengths
  float near = 0, far = std::numeric_limits<float>::infinity();
};

}  // namespace terrabench
