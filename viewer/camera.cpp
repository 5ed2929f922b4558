#include "viewer/camera.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "lod/camera/camera_path.h"
#include "terrain/framing.h"
#include "viewer/pick.h"

namespace terrabench::viewer {
namespace {

constexpr double kSteepest = 89;      // degrees: beyond, left and right would change places
constexpr double kSpeedShare = 0.05;  // of the ground's longer side, per second
constexpr double kZoomStep = 1.2;     // per step of the wheel
constexpr double kFarthest = 4;       // sides of the ground, of the eye from the middle

double limited(double value, double most) { return std::clamp(value, -most, most); }

}  // namespace

double Camera::extent() const {
  return static_cast<double>(std::max(ground_->extent_x(), ground_->extent_z()));
}

void Camera::stand_on(const Heightfield& ground, const Bounds& bounds) {
  ground_ = &ground;
  bounds_ = &bounds;
  set_speed(kSpeedShare * extent());
  home();
}

void Camera::keep_on(const Heightfield& ground, const Bounds& bounds) {
  ground_ = &ground;
  bounds_ = &bounds;
  keep_above();
}

void Camera::home() {
  const glm::dvec3 size(bounds_->size());
  heading_ = -3;
  eye_ = {0.5 * size.x, 0, 0.82 * size.z};
  eye_.y = ground_under(*ground_, {eye_.x, eye_.z}) + 0.03 * extent() + 0.15 * size.y;
  pitch_ = -5;
  set_motion(motion_);
}

void Camera::set_motion(Motion motion) {
  motion_ = motion;
  if (motion == Motion::kPlan) eye_.y = ground_under(*ground_, {eye_.x, eye_.z}) + 0.5 * extent();
  if (motion == Motion::kOrbit) set_orbit();
  keep_above();
}

// Around the place in the middle of the picture; where that is sky, a place ahead.
void Camera::set_orbit() {
  const glm::dvec3 ahead = direction();
  const double reach = 0.3 * extent();
  place_ = pick(*ground_, eye_, ahead).value_or(eye_ + ahead * reach);
  place_.x = std::clamp(place_.x, 0.0, static_cast<double>(ground_->extent_x()));
  place_.z = std::clamp(place_.z, 0.0, static_cast<double>(ground_->extent_z()));
  place_.y = ground_under(*ground_, {place_.x, place_.z});
  look_at(place_);
}

void Camera::look_at(const glm::dvec3& place) {
  const glm::dvec3 sight = place - eye_;
  away_ = std::max(glm::length(sight), least_eye_height(*ground_));
  if (std::hypot(sight.x, sight.z) > 0) {
    const double heading = glm::degrees(std::atan2(sight.x, -sight.z));
    heading_ += std::remainder(heading - heading_, 360);  // without a turn round
  }
  pitch_ = limited(glm::degrees(std::asin(std::clamp(sight.y / away_, -1.0, 1.0))), kSteepest);
}

glm::dvec3 Camera::direction() const {
  if (motion_ == Motion::kPlan) return {0, -1, 0};
  const double heading = glm::radians(heading_), pitch = glm::radians(pitch_);
  return {std::sin(heading) * std::cos(pitch), std::sin(pitch), -std::cos(heading) * std::cos(pitch)};
}

void Camera::move(const glm::dvec3& way, double seconds) {
  const double heading = glm::radians(heading_);
  const glm::dvec3 right(std::cos(heading), 0, std::sin(heading)),
      level(std::sin(heading), 0, -std::cos(heading));
  const glm::dvec3 forward = motion_ == Motion::kFly ? direction() : level;
  const double up = motion_ == Motion::kWalk || motion_ == Motion::kOrbit ? 0 : way.y;
  const glm::dvec3 by = (right * way.x + glm::dvec3(0, up, 0) + forward * way.z) * speed_ * seconds;
  if (motion_ == Motion::kOrbit) place_ += by;
  eye_ += by;
  keep_above();
}

void Camera::turn(double right, double up) {
  heading_ += right;
  if (motion_ == Motion::kPlan) return;
  pitch_ = limited(pitch_ + up, kSteepest);
  keep_above();
}

void Camera::zoom(double steps) {
  const double factor = std::pow(kZoomStep, steps);
  if (motion_ == Motion::kOrbit) {
    away_ = std::clamp(away_ / factor, least_eye_height(*ground_), kFarthest * extent());
  } else if (motion_ == Motion::kPlan) {
    const double ground = ground_under(*ground_, {eye_.x, eye_.z});
    eye_.y = ground + (eye_.y - ground) / factor;
  } else {
    set_speed(speed_ * factor);
  }
  keep_above();
}

void Camera::set_speed(double metres_per_second) {
  speed_ = std::clamp(metres_per_second, 1e-4 * extent(), 2 * extent());
}

void Camera::place(const glm::dvec3& eye, double heading, double pitch) {
  eye_ = eye;
  heading_ = heading;
  pitch_ = limited(pitch, kSteepest);
  if (motion_ == Motion::kOrbit) set_orbit();
  keep_above();
}

void Camera::take(const View& view) {
  eye_ = view.eye;
  look_at(eye_ + glm::dvec3(view.target) - glm::dvec3(view.eye));
  field_of_view = glm::degrees(static_cast<double>(view.vertical_fov));
  if (motion_ == Motion::kOrbit) set_orbit();
  keep_above();
}

// Of an orbit, the eye follows the place; then the eye is lifted to the least height, or set to it on foot.
void Camera::keep_above() {
  if (motion_ == Motion::kOrbit) {
    place_.y = ground_under(*ground_, {place_.x, place_.z});
    eye_ = place_ - away_ * direction();
  }
  const double reach = kFarthest * extent();
  const glm::dvec3 middle(0.5F * (bounds_->low + bounds_->high));
  eye_ = middle + glm::clamp(eye_ - middle, -reach, reach);
  const double least = ground_under(*ground_, {eye_.x, eye_.z}) + least_eye_height(*ground_);
  eye_.y = motion_ == Motion::kWalk ? least : std::max(eye_.y, least);
  if (motion_ == Motion::kOrbit) look_at(place_);
}

View Camera::view(int width, int height) const {
  View view;
  const glm::dvec3 sight = direction();
  const double heading = glm::radians(heading_);
  view.eye = eye_;
  // So far away that float rounding of eye and target does not rotate the view.
  view.target = eye_ + sight * std::max(1.0, 0.1 * extent());
  view.up = upright(glm::dvec3(view.target - view.eye), {std::sin(heading), 0, -std::cos(heading)});
  view.vertical_fov = static_cast<float>(field_of_view) * 3.14159265F / 180;  // as `render --fov`
  view.width = width;
  view.height = height;
  view.far = 0;
  set_depth_planes(view, *ground_, *bounds_, true);
  return view;
}

}  // namespace terrabench::viewer
