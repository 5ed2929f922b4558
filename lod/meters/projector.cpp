#include "lod/meters/projector.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace terrabench {

Projector::Projector(const View& view)
    : eye_(view.eye),
      forward_(glm::normalize(glm::dvec3(view.target) - eye_)),
      focal_(0.5 * view.height / std::tan(0.5 * static_cast<double>(view.vertical_fov))),
      width_(view.width),
      height_(view.height),
      near_(view.near),
      far_(view.far) {
  right_ = glm::normalize(glm::cross(forward_, glm::dvec3(view.up)));
  above_ = glm::cross(right_, forward_);
}

ScreenPoint Projector::operator()(const glm::dvec3& point) const {
  const glm::dvec3 from_eye = point - eye_;
  const double depth = glm::dot(from_eye, forward_);
  return {0.5 * width_ + focal_ * glm::dot(from_eye, right_) / depth,
          0.5 * height_ - focal_ * glm::dot(from_eye, above_) / depth, depth};
}

bool Projector::in_view(const ScreenPoint& at) const {
  return at.depth >= near_ && at.depth <= far_ && at.x >= 0 && at.x <= width_ && at.y >= 0 && at.y <= height_;
}

double Projector::pixels_between(const glm::dvec3& p, const glm::dvec3& q) const {
  const double depth_p = glm::dot(p - eye_, forward_), depth_q = glm::dot(q - eye_, forward_);
  if (depth_p < near_ && depth_q < near_) return 0;
  const auto before_near = [&](const glm::dvec3& point, double depth, const glm::dvec3& other, double there) {
    return (*this)(depth >= near_ ? point : glm::mix(point, other, (near_ - depth) / (there - depth)));
  };
  const ScreenPoint a = before_near(p, depth_p, q, depth_q), b = before_near(q, depth_q, p, depth_p);
  return std::hypot(a.x - b.x, a.y - b.y);
}

bool Projector::sees_segment(const glm::dvec3& p, const glm::dvec3& q) const {
  // Liang and Barsky's clipping against the six planes, each moved inwards by a small margin.
  constexpr double kMargin = 1e-6;
  double from = 0, to = 1;
  const auto clip = [&](double at_p, double at_q) {
    if (at_p < 0 && at_q < 0) return false;
    if (at_p < 0) from = std::max(from, at_p / (at_p - at_q));
    if (at_q < 0) to = std::min(to, at_p / (at_p - at_q));
    return from < to;
  };
  const glm::dvec3 a = p - eye_, b = q - eye_;
  const double depth_a = glm::dot(a, forward_), depth_b = glm::dot(b, forward_);
  const double reach_x = 0.5 * width_ / focal_ * (1 - kMargin),
               reach_y = 0.5 * height_ / focal_ * (1 - kMargin);
  const double x_a = glm::dot(a, right_), x_b = glm::dot(b, right_);
  const double y_a = glm::dot(a, above_), y_b = glm::dot(b, above_);
  return clip(depth_a - near_ * (1 + kMargin), depth_b - near_ * (1 + kMargin)) &&
         clip(far_ * (1 - kMargin) - depth_a, far_ * (1 - kMargin) - depth_b) &&
         clip(reach_x * depth_a - x_a, reach_x * depth_b - x_b) &&
         clip(reach_x * depth_a + x_a, reach_x * depth_b + x_b) &&
         clip(reach_y * depth_a - y_a, reach_y * depth_b - y_b) &&
         clip(reach_y * depth_a + y_a, reach_y * depth_b + y_b);
}

}  // namespace terrabench
