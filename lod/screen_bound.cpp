#include "lod/screen_bound.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace terrabench {

ScreenBound::ScreenBound(const View& view, double pixels)
    : eye_(view.eye),
      forward_(glm::normalize(glm::dvec3(view.target) - eye_)),
      pixels_(pixels),
      near_(view.near) {
  const double slope_y = std::tan(0.5 * static_cast<double>(view.vertical_fov));
  const double slope_x = slope_y * view.width / view.height;
  focal_ = 0.5 * view.height / slope_y;
  secant_ = std::sqrt(1 + slope_x * slope_x + slope_y * slope_y);
}

float ScreenBound::allowed(const Bounds& box) const {
  const glm::dvec3 low = glm::dvec3(box.low) - eye_, high = glm::dvec3(box.high) - eye_;
  const glm::dvec3 nearest = glm::max(glm::max(low, -high), 0.0);
  const glm::dvec3 farthest = glm::max(-low, high);
  const glm::dvec3 ahead = glm::min(low * forward_, high * forward_);
  const double least_depth = std::max({near_, glm::length(nearest) / secant_, ahead.x + ahead.y + ahead.z});
  const double spread = std::min(secant_, std::hypot(farthest.x, farthest.z) / least_depth);
  // A hair less, for the rounding of whoever checks.
  return static_cast<float>((1 - 1e-6) * pixels_ * least_depth /
                            (focal_ * spread + pixels_ * std::abs(forward_.y)));
}

float ScreenBound::allowed_level_camera(const glm::vec3& middle) const {
  return static_cast<float>(pixels_ * glm::distance(glm::dvec3(middle), eye_) / focal_);
}

}  // namespace terrabench
