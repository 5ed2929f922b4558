#include "lod/screen_bound.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

namespace terrabench {
namespace {

// Levels that a patch does not have are given an infinite error, so no bound may be infinite.
float finite(double metres) {
  return static_cast<float>(std::min(metres, double{std::numeric_limits<float>::max()}));
}

}  // namespace

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

// Without branches, so that the compiler vectorises the loop over boxes.
[[gnu::always_inline]] inline float ScreenBound::allow_in(float low_x, float high_x, float low_y,
                                                          float high_y, float low_z, float high_z) const {
  const auto beyond = [](double low, double high) { return std::max(std::max(low, -high), 0.0); };
  const double x0 = low_x - eye_.x, x1 = high_x - eye_.x, y0 = low_y - eye_.y, y1 = high_y - eye_.y,
               z0 = low_z - eye_.z, z1 = high_z - eye_.z;
  const double x = beyond(x0, x1), y = beyond(y0, y1), z = beyond(z0, z1);
  const double far_x = std::max(-x0, x1), far_z = std::max(-z0, z1);
  const double ahead = std::min(x0 * forward_.x, x1 * forward_.x) +
                       std::min(y0 * forward_.y, y1 * forward_.y) +
                       std::min(z0 * forward_.z, z1 * forward_.z);
  const double least_depth = std::max(std::max(near_, std::sqrt(x * x + y * y + z * z) / secant_), ahead);
  const double spread = std::min(secant_, std::sqrt(far_x * far_x + far_z * far_z) / least_depth);
  // Slightly less, so that a check of the bound may round differently.
  return finite((1 - 1e-6) * pixels_ * least_depth / (focal_ * spread + pixels_ * std::abs(forward_.y)));
}

float ScreenBound::allow(const Bounds& box) const {
  return allow_in(box.low.x, box.high.x, box.low.y, box.high.y, box.low.z, box.high.z);
}

void ScreenBound::allow(const Boxes& boxes, std::size_t first, std::size_t last, float* metres) const {
  const float *const low_x = boxes.low[0].data(), *const high_x = boxes.high[0].data(),
                     *const low_y = boxes.low[1].data(), *const high_y = boxes.high[1].data(),
                     *const low_z = boxes.low[2].data(), *const high_z = boxes.high[2].data();
  const ScreenBound local = *this;
  for (std::size_t k = first; k < last; ++k) {
    metres[k] = local.allow_in(low_x[k], high_x[k], low_y[k], high_y[k], low_z[k], high_z[k]);
  }
}

// Of a ball around eye_ + off.
double ScreenBound::least_depth(const glm::dvec3& off, double radius) const {
  const double nearest = std::max(near_, (std::sqrt(glm::dot(off, off)) - radius) / secant_);
  return std::max(nearest, glm::dot(off, forward_) - radius);
}

double ScreenBound::allow(const glm::dvec3& centre, double radius) const {
  const glm::dvec3 off = centre - eye_;
  const double least = least_depth(off, radius);
  const double spread = std::min(secant_, (std::sqrt(off.x * off.x + off.z * off.z) + radius) / least);
  return (1 - 1e-6) * pixels_ * least / (focal_ * spread + pixels_ * std::abs(forward_.y));
}

void ScreenBound::allow_level_camera(const Boxes& boxes, std::size_t first, std::size_t last,
                                     float* metres) const {
  for (std::size_t k = first; k < last; ++k) {
    glm::vec3 middle;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      middle[static_cast<int>(axis)] = 0.5F * (boxes.low[axis][k] + boxes.high[axis][k]);
    }
    metres[k] = finite(pixels_ * glm::distance(glm::dvec3(middle), eye_) / focal_);
  }
}

}  // namespace terrabench
