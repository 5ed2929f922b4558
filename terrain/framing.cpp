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

Bounds bounds_of(const Heightfield& field) {
  const HeightRange range = height_range(field);
  return {{0, range.lowest, 0}, {field.extent_x(), range.highest, field.extent_z()}};
}

void set_depth_planes(View& view, const Heightfield& field, const Bounds& ground, bool alone) {
  // Shares of the far plane's distance. With the first, OpenGL's depth has relative errors of at most 0.6 %.
  // They are larger for an eye so low that it would see through the ground before its feet.
  constexpr float kNear = 1e-5F, kNearest = 1e-7F;
  view.far = std::max({view.far, kFarSides * std::max(field.extent_x(), field.extent_z()),
                       static_cast<float>(far_plane(view.eye, ground))});
  view.near = kNear * view.far;
  const float above = view.eye.y - field.sample(view.eye.x, view.eye.z);
  if (above > 0) view.near = std::clamp(0.25F * above, kNearest * view.far, view.near);
  if (alone) view.near = std::max(view.near, 0.99F * depth_range(view, ground).nearest);
}

}  // namespace terrabench
