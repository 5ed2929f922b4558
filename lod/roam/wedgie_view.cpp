#include "lod/roam/wedgie_view.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace terrabench::roam {

WedgieView::WedgieView(const View& view, double extent) : eye_(view.eye) {
  forward_ = glm::normalize(glm::dvec3(view.target) - eye_);
  right_ = glm::normalize(glm::cross(forward_, glm::normalize(glm::dvec3(view.up))));
  up_ = glm::cross(right_, forward_);
  const double y = std::tan(0.5 * view.vertical_fov), x = y * view.width / view.height;
  lens_ = {x, y, view.near, 0.5 * view.height / y, extent};
  far_ = view.far;
  // A point this close to a plane may fall on its other side in the float matrices that draw it.
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

Distortion WedgieView::distortion(const ViewedCorner& a, const ViewedCorner& b, const ViewedCorner& c,
                                  double thickness) const {
  const double nearest = std::min(a.depth, std::min(b.depth, c.depth));
  const double depth = nearest - thickness * std::abs(forward_.y);
  const double reach =
      std::sqrt(std::max(a.distance_squared, std::max(b.distance_squared, c.distance_squared))) + thickness;
  if (!(depth > near())) return {std::numeric_limits<double>::infinity(), 0, reach};
  const double up = std::sqrt(std::max(std::max(a.up_squared, 1e-12), std::max(b.up_squared, c.up_squared)));
  // Relative change per metre: (1 + up_rate) / depth for S, 1 / up + 2 / depth for N / R.
  return {lens_[3] * thickness / depth * std::min(largest_up_, up / depth),
          std::min(depth / (1 + up_rate_), up * depth / (depth + 2 * up)), reach};
}

// A wedgie's distance from a plane changes by at most moved + ρ·turned, where ρ is the distance from the eye
// to its farthest point. Half of `slack` is granted to each term.
Culling WedgieView::cull(const Corners& corners, double thickness, double spill, CullLabel parent) const {
  CullLabel label = parent;
  double slack = std::numeric_limits<double>::infinity(), outside = 0;  // metres
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
    if (inside >= 0) label |= static_cast<CullLabel>(1U << i);
  }
  if (outside > 0) {
    label = kOutside;
    slack = outside;  // the label stays as long as the wedgie is outside of this one plane
  }
  double farthest = 0;
  for (const glm::dvec3& corner : corners.at) {
    farthest = std::max(farthest, glm::dot(corner - eye_, corner - eye_));
  }
  const double reach = std::sqrt(farthest) * (1 + 2 * spill) + thickness;
  return {label, {0.5 * slack, 0.5 * slack / std::max(reach, 1e-9)}};
}

Motion WedgieView::since(const WedgieView& before) const {
  const auto squared = [](const glm::dvec3& a, const glm::dvec3& b) { return glm::dot(a - b, a - b); };
  const double axes =
      squared(right_, before.right_) + squared(up_, before.up_) + squared(forward_, before.forward_);
  return {glm::length(eye_ - before.eye_), std::sqrt(0.5 * axes)};
}

}  // namespace terrabench::roam
