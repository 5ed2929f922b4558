#include "lod/camera/camera_path.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "lod/lod.h"
#include "terrain/error.h"

namespace terrabench {
namespace {

constexpr double kEyeHeight = 1.8;  // metres
constexpr double kMostFrames = 1e6;

// A path over a particular ground, in metres.
class Flight {
 public:
  Flight(const CameraPath& path, const Heightfield& ground)
      : path_(path),
        ground_(ground),
        extent_(ground.extent_x(), ground.extent_z()),
        unit_(path.by_extent ? std::max(extent_.x, extent_.y) : 1.0),
        heights_(height_range(ground)) {
    double time = 0;
    for (std::size_t k = 0; k < path.keyframes.size(); ++k) {
      if (k > 0) time += distance(path.keyframes[k - 1], path.keyframes[k]) / path.keyframes[k - 1].speed;
      times_.push_back(time);
    }
  }

  double seconds() const { return times_.back(); }

  View view_at(double time) const {
    const auto after = std::upper_bound(times_.begin() + 1, times_.end() - 1, time);
    const std::size_t k = static_cast<std::size_t>(after - times_.begin());
    const Keyframe &from = path_.keyframes[k - 1], &to = path_.keyframes[k];
    const double lasts = times_[k] - times_[k - 1];
    // A short time may round to 0 when it is added to a long one.
    const double share = lasts > 0 ? std::clamp((time - times_[k - 1]) / lasts, 0.0, 1.0) : 1;
    const bool turns = path_.kind == CameraPath::Kind::kTurn;
    const glm::dvec2 plan =
        turns ? place(path_.keyframes.front().at) : glm::mix(place(from.at), place(to.at), share);
    const glm::dvec3 eye(plan.x, eye_height(plan, from, to, share), plan.y);
    return look(eye, direction(eye, from, to, share));
  }

 private:
  // What the speed covers between two keyframes: units or degrees.
  double distance(const Keyframe& a, const Keyframe& b) const {
    return path_.kind == CameraPath::Kind::kTurn ? std::abs(b.heading - a.heading)
                                                 : glm::distance(a.at, b.at);
  }

  glm::dvec2 place(const glm::dvec2& at) const { return path_.origin * extent_ + at * unit_; }

  double ground_at(const glm::dvec2& at) const {
    const glm::dvec2 inside = glm::clamp(at, glm::dvec2(0), extent_);
    return ground_.sample(std::min(static_cast<float>(inside.x), ground_.extent_x()),
                          std::min(static_cast<float>(inside.y), ground_.extent_z()));
  }

  double eye_height(const glm::dvec2& plan, const Keyframe& from, const Keyframe& to, double share) const {
    const double least = ground_at(plan) + kEyeHeight;
    if (path_.kind != CameraPath::Kind::kFly) return least;
    const auto above = [&](const Keyframe& key) { return ground_at(place(key.at)) + key.height * unit_; };
    return std::max(glm::mix(above(from), above(to), share), least);
  }

  glm::dvec3 direction(const glm::dvec3& eye, const Keyframe& from, const Keyframe& to, double share) const {
    if (path_.look == CameraPath::Look::kHeading) {
      const double heading = glm::radians(glm::mix(from.heading, to.heading, share));
      const double pitch = glm::radians(glm::mix(from.pitch, to.pitch, share));
      return {std::sin(heading) * std::cos(pitch), std::sin(pitch), -std::cos(heading) * std::cos(pitch)};
    }
    if (path_.look == CameraPath::Look::kPlace) {
      const glm::dvec2 plan = glm::mix(place(from.look_at), place(to.look_at), share);
      const glm::dvec3 way = glm::dvec3(plan.x, ground_at(plan), plan.y) - eye;
      // Looking straight down leaves the up vector undefined; look along the path instead.
      if (std::hypot(way.x, way.z) > 1e-3 * std::abs(way.y)) return glm::normalize(way);
    }
    const glm::dvec2 ahead = glm::normalize(to.at - from.at);
    return {ahead.x, 0, ahead.y};
  }

  View look(const glm::dvec3& eye, const glm::dvec3& direction) const {
    View view;
    view.eye = eye;
    // So far away that float rounding of eye and target does not rotate the view.
    view.target = eye + direction * std::max(1.0, 0.1 * glm::length(extent_));
    view.vertical_fov = static_cast<float>(glm::radians(path_.field_of_view));
    view.width = path_.screen.x;
    view.height = path_.screen.y;
    view.near = static_cast<float>(path_.near);
    const glm::dvec3 low(0, heights_.lowest, 0), high(extent_.x, heights_.highest, extent_.y);
    const double farthest = glm::length(glm::max(glm::abs(eye - low), glm::abs(eye - high)));
    view.far = static_cast<float>(std::max(1.01 * farthest, 2 * path_.near));
    return view;
  }

  const CameraPath& path_;
  const Heightfield& ground_;
  glm::dvec2 extent_;
  double unit_;
  HeightRange heights_;
  std::vector<double> times_;  // at each keyframe, seconds
};

}  // namespace

std::vector<View> views(const CameraPath& path, const Heightfield& ground) {
  check_ground(ground);
  const Flight flight(path, ground);
  const double frames = std::floor(flight.seconds() * path.frames_per_second + 1e-9) + 1;
  if (!(frames <= kMostFrames)) {
    throw usage_error(fmt::format("the path has {:.3g} frames", frames), path.name,
                      "give a higher speed or fewer frames per second, for at most a million frames");
  }
  std::vector<View> all(static_cast<std::size_t>(frames));
  for (std::size_t k = 0; k < all.size(); ++k) {
    all[k] = flight.view_at(static_cast<double>(k) / path.frames_per_second);
    check_view(all[k]);
  }
  return all;
}

}  // namespace terrabench
