#include "lod/camera/camera_path.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <limits>

#include "lod/lod.h"
#include "terrain/error.h"
#include "terrain/framing.h"

namespace terrabench {
namespace {

constexpr double kEyeHeight = 1.8;          // metres, on ground longer than kEyeHeight / kEyeShare
constexpr double kEyeShare = 0.1;           // of the longer side, on smaller ground
constexpr double kNear = 0.5 / kEyeHeight;  // per metre of the least eye height
constexpr double kMostFrames = 1e6;

// Metres per unit: of places along x and z, and of heights.
struct Scale {
  glm::dvec2 place;
  double height;
};

// How much longer the unit of places may become until a keyframe leaves the ground.
double room(const CameraPath& path, const glm::dvec2& extent, double unit) {
  double factor = std::numeric_limits<double>::infinity();
  for (const Keyframe& key : path.keyframes) {
    for (int axis = 0; axis < 2; ++axis) {
      const double way = std::abs(key.at[axis]) * unit;
      const double share = key.at[axis] > 0 ? 1 - path.origin[axis] : path.origin[axis];
      if (way > 0 && share > 0) factor = std::min(factor, share * extent[axis] / way);
    }
  }
  return factor;
}

Scale scale_of(const CameraPath& path, const glm::dvec2& extent) {
  constexpr double kFilled = 0.9;  // of the room: then no eye stands at the border, beyond which nothing is
  double unit = path.by_extent ? std::max(extent.x, extent.y) : 1;
  const double free = room(path, extent, unit);
  if (path.by_extent && free < 1) return {extent, std::min(extent.x, extent.y)};
  if (path.shrinks) unit = std::min(unit, kFilled * free);
  return {glm::dvec2(unit), unit};
}

// A path over a particular ground, in metres.
class Flight {
 public:
  Flight(const CameraPath& path, const Heightfield& ground)
      : path_(path),
        ground_(ground),
        extent_(ground.extent_x(), ground.extent_z()),
        scale_(scale_of(path, extent_)),
        least_height_(least_eye_height(ground)) {
    const HeightRange heights = height_range(ground);
    box_ = {{0, heights.lowest, 0}, {extent_.x, heights.highest, extent_.y}};
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
    const glm::dvec3 way = direction(eye, from, to, share);
    // A heading looks straight down with what lies ahead at the picture's top; other plans have north there.
    const double heading = glm::radians(glm::mix(from.heading, to.heading, share));
    return look(eye, way, upright(way, {std::sin(heading), 0, -std::cos(heading)}));
  }

 private:
  // What the speed covers between two keyframes: units or degrees.
  double distance(const Keyframe& a, const Keyframe& b) const {
    return path_.kind == CameraPath::Kind::kTurn ? std::abs(b.heading - a.heading)
                                                 : glm::distance(a.at, b.at);
  }

  glm::dvec2 place(const glm::dvec2& at) const { return path_.origin * extent_ + at * scale_.place; }

  double eye_height(const glm::dvec2& plan, const Keyframe& from, const Keyframe& to, double share) const {
    const double least = ground_under(ground_, plan) + least_height_;
    if (path_.kind != CameraPath::Kind::kFly) return least;
    const auto above = [&](const Keyframe& key) {
      return ground_under(ground_, place(key.at)) + key.height * scale_.height;
    };
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
      return glm::normalize(glm::dvec3(plan.x, ground_under(ground_, plan), plan.y) - eye);
    }
    const glm::dvec2 ahead = glm::normalize(to.at - from.at);
    return {ahead.x, 0, ahead.y};
  }

  View look(const glm::dvec3& eye, const glm::dvec3& direction, const glm::vec3& up) const {
    View view;
    view.eye = eye;
    // So far away that float rounding of eye and target does not rotate the view.
    view.target = eye + direction * std::max(1.0, 0.1 * glm::length(extent_));
    view.up = path_.up.value_or(up);
    view.vertical_fov = static_cast<float>(glm::radians(path_.field_of_view));
    view.width = path_.screen.x;
    view.height = path_.screen.y;
    const double near = path_.near.value_or(kNear * least_height_);
    view.near = static_cast<float>(near);
    view.far = static_cast<float>(std::max(far_plane(eye, box_), 2 * near));
    return view;
  }

  const CameraPath& path_;
  const Heightfield& ground_;
  glm::dvec2 extent_;
  Scale scale_;
  double least_height_;        // of the eye above the ground, metres
  Bounds box_;                 // of the ground
  std::vector<double> times_;  // at each keyframe, seconds
};

}  // namespace

double least_eye_height(const Heightfield& ground) {
  const auto side = static_cast<double>(std::max(ground.extent_x(), ground.extent_z()));
  return std::min(kEyeHeight, kEyeShare * side);
}

double ground_under(const Heightfield& ground, const glm::dvec2& at) {
  const glm::dvec2 inside = glm::clamp(at, glm::dvec2(0), glm::dvec2(ground.extent_x(), ground.extent_z()));
  return static_cast<double>(ground.sample(std::min(static_cast<float>(inside.x), ground.extent_x()),
                                           std::min(static_cast<float>(inside.y), ground.extent_z())));
}

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
