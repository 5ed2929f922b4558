#include "renderers/raytrace/ray_camera.h"

#include <fmt/format.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "terrain/error.h"

namespace terrabench {

RayCamera::RayCamera(const View& view) : eye_(view.eye) {
  if (view.width < 1 || view.height < 1 || view.width > kLargestSide || view.height > kLargestSide) {
    throw usage_error(fmt::format("invalid size of picture: {} x {}", view.width, view.height), "ray tracing",
                      fmt::format("both sides must be 1 to {} pixels", kLargestSide));
  }
  forward_ = glm::normalize(view.target - view.eye);
  right_ = glm::normalize(glm::cross(forward_, view.up));
  up_ = glm::cross(right_, forward_);
  const bool good = is_finite(forward_) && is_finite(right_) && is_finite(up_) && view.vertical_fov > 0 &&
                    view.vertical_fov < 3.14F;
  if (!good) {
    throw usage_error("invalid view", "ray tracing",
                      "the eye and its target must be finite and differ, up must point to another direction, "
                      "and the field of view lie between 0 and 180°");
  }
  middle_ = 0.5F * glm::vec2(view.width, view.height);
  scale_ = middle_.y / std::tan(0.5F * view.vertical_fov);
}

Ray RayCamera::ray(const glm::vec2& at) const {
  const glm::vec2 slope = (at - middle_) / scale_;
  return {.origin = eye_, .direction = glm::normalize(forward_ + slope.x * right_ - slope.y * up_)};
}

glm::vec3 RayCamera::project(const glm::vec3& position) const {
  const glm::vec3 offset = position - eye_;
  const float depth = glm::dot(offset, forward_);
  return {scale_ * glm::dot(offset, right_) + middle_.x * depth,
          -scale_ * glm::dot(offset, up_) + middle_.y * depth, depth};
}

}  // namespace terrabench
