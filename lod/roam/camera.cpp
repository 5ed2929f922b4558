#include "lod/roam/camera.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace terrabench::roam {

Camera::Camera(const View& view, double extent) : eye_(view.eye) {
  forward_ = glm::normalize(glm::dvec3(view.target) - eye_);
  right_ = glm::normalize(glm::cross(forward_, glm::normalize(glm::dvec3(view.up))));
  up_ = glm::cross(right_, forward_);
  const double y = std::tan(0.5 * view.vertical_fov), x = y * view.width / view.height;
  lens_ = {x, y, view.near, 0.5 * view.height / y, extent};
  far_ = view.far;
  // Float matrices put a point on another side of a plane than we do when it is about this near to it.
  const double rounding = 1e-6 * (extent + glm::length(eye_));
  const auto plane = [&](const glm::dvec3& normal, double offset) {
    const double length = glm::length(normal);
    return Plane{normal / length, (offset - glm::dot(normal, eye_)) / length + rounding};
  };
  planes_ = {plane(x * forward_ + right_, 0), plane(x * forward_ - right_, 0), plane(y * forward_ + up_, 0),
             plane(y * forward_ - up_, 0),    plane(forward_, -view.near),     plane(-forward_, view.far)};
  for (const double corner_x : {-x, x}) {
    for (const double corner_y : {-y, y}) {
      largest_up_ =
          std::max(largest_up_, std::hypot(right_.y - forward_.y * corner_x, up_.y - forward_.y * corner_y));
    }
  }
  up_rate_ = std::sqrt(1 + x * x + y * y) / largest_up_;
}

Distortion Camera::distortion(const Spot& a, const Spot& b, const Spot& c, double thickness) const {
  const double nearest = std::min(a.depth, std::min(b.depth, c.depth));
  const double depth = nearest - thickness * std::abs(forward_.y);
  const double reach = std::sqrt(std::max(a.away, std::max(b.away, c.away))) + thickness;
  if (!(depth > near())) return {std::numeric_limits<double>::infinity(), 0, reach};
  const double up = std::sqrt(std::max(std::max(a.up, 1e-12), std::max(b.up, c.up)));
  // The rate of change a metre is that of S, (1 + up_rate) / depth, or that of N / R, 1 / up + 2 / depth.
  return {lens_[3] * thickness / depth * std::min(largest_up_, up / depth),
          std::min(depth / (1 + up_rate_), up * depth / (depth + 2 * up)), reach};
}

// A corner's distance from a plane changes by moved + ρ·turned at most, and so does a wedgie's, ρ being the
// distance of its farthest point. Half of the slack is for either.
Seeing Camera::sight(const Corners& corners, double thickness, double spill, Sight parent) const {
  Sight sight = parent;
  double slack = std::numeric_limits<double>::infinity(), outside = 0;
  for (int i = 0; i < 6; ++i) {
    if ((parent >> i & 1) != 0) continue;
    const Plane& plane = planes_[i];
    const double a = glm::dot(plane.normal, corners.at[0]), b = glm::dot(plane.normal, corners.at[1]),
                 c = glm::dot(plane.normal, corners.at[2]);
    const double low = std::min(a, std::min(b, c)), high = std::max(a, std::max(b, c));
    const double margin = thickness * std::abs(plane.normal.y) + spill * (high - low);
    const double inside = low + plane.offset - margin, beyond = -(high + plane.offset + margin);
    outside = std::max(outside, beyond);
    slack = std::min(slack, std::min(std::abs(inside), std::abs(beyond)));
    if (inside >= 0) sight |= static_cast<Sight>(1U << i);
  }
  if (outside > 0) {
    sight = kOutside;
    slack = outside;  // as long as it is outside one plane the others do not matter
  }
  double farthest = 0;
  for (const glm::dvec3& corner : corners.at) {
    farthest = std::max(farthest, glm::dot(corner - eye_, corner - eye_));
  }
  const double reach = std::sqrt(farthest) * (1 + 2 * spill) + thickness;
  return {sight, {0.5 * slack, 0.5 * slack / std::max(reach, 1e-9)}};
}

Motion Camera::since(const Camera& before) const {
  const auto squared = [](const glm::dvec3& a, const glm::dvec3& b) { return glm::dot(a - b, a - b); };
  const double axes =
      squared(right_, before.right_) + squared(up_, before.up_) + squared(forward_, before.forward_);
  return {glm::length(eye_ - before.eye_), std::sqrt(0.5 * axes)};
}

}  // namespace terrabench::roam
