#include "terrain/framing.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

namespace terrabench {

glm::vec3 upright(const glm::dvec3& sight, const glm::vec3& ahead) {
  constexpr double kVertical = 1e-4;  // radians; below, rounding of eye and target would turn the picture
  const bool plan = std::hypot(sight.x, sight.z) <= kVertical * std::abs(sight.y);
  if (!plan) return {0, 1, 0};
  return sight.y < 0 ? ahead : -ahead;  // so that a look that tilts up to the zenith does not turn there
}

double far_plane(const glm::dvec3& eye, const Bounds& box) {
  const glm::dvec3 low(box.low), high(box.high);
  return 1.01 * glm::length(glm::max(glm::abs(eye - low), glm::abs(eye - high)));
}

DepthRange depth_range(const View& view, const Bounds& bounds) {
  const glm::vec3 forward = glm::normalize(view.target - view.eye);
  DepthRange range{std::numeric_limits<float>::infinity(), -std::numeric_limits<float>::infinity()};
  for (int corner = 0; corner < 8; ++corner) {
    const float depth = glm::dot(bounds.corner(corner) - view.eye, forward);
    range = {std::min(range.nearest, depth), std::max(range.farthest, depth)};
  }
  return range;
}

}  // namespace terrabench
