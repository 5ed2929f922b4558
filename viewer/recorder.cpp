#include "viewer/recorder.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace terrabench::viewer {
namespace {

constexpr double kStandsStill = 1e-3;  // metres: less is no motion
constexpr double kLooksStill = 1e-3;   // degrees
constexpr double kRounding = 1e-6;     // seconds

Keyframe keyframe_of(const Camera& camera, const Heightfield& ground) {
  Keyframe key;
  key.at = {camera.eye().x, camera.eye().z};
  key.height = std::max(0.0, camera.eye().y - ground_under(ground, key.at));
  key.heading = camera.heading();
  key.pitch = camera.motion() == Motion::kPlan ? -90 : camera.pitch();
  return key;
}

}  // namespace

void Recorder::begin(glm::ivec2 window) {
  *this = Recorder();
  recording_ = true;
  window_ = window;
}

// Still at the last stop. The first stop keeps the eye's latest direction, later ones that of arrival.
void Recorder::stand(const Stop& now) {
  stops_.back().left = now.left;
  latest_.reset();
  if (stops_.size() > 1) return;
  stops_.back().key = now.key;
  if (std::abs(turns_.back().key.heading - now.key.heading) > kLooksStill) turns_.push_back(now);
}

void Recorder::add(const Camera& camera, const Heightfield& ground, double seconds) {
  if (!recording_) return;
  walking_ = walking_ && camera.motion() == Motion::kWalk;
  field_of_view_ = camera.field_of_view;
  const Stop now{keyframe_of(camera, ground), seconds, seconds};
  if (stops_.empty()) {
    stops_ = turns_ = {now};
  } else if (glm::distance(stops_.back().key.at, now.key.at) <= kStandsStill) {
    stand(now);
  } else if (now.arrived - stops_.back().left < kInterval - kRounding) {
    latest_ = now;
  } else {
    stops_.push_back(now);
    latest_.reset();
  }
}

std::optional<CameraPath> Recorder::end() {
  recording_ = false;
  if (latest_) stops_.push_back(*latest_);
  CameraPath path;
  path.name = "recorded";
  path.look = CameraPath::Look::kHeading;
  path.kind = stops_.size() < 2 ? CameraPath::Kind::kTurn
              : walking_        ? CameraPath::Kind::kWalk
                                : CameraPath::Kind::kFly;
  const bool turns = path.kind == CameraPath::Kind::kTurn;
  const std::vector<Stop>& used = turns ? turns_ : stops_;
  if (used.size() < 2) return std::nullopt;
  path.screen = window_;
  path.field_of_view = field_of_view_;
  for (std::size_t k = 0; k < used.size(); ++k) {
    Keyframe key = used[k].key;
    // The speed on the way to the next keyframe; the last one's is not used, but must be there.
    const std::size_t from = std::min(k, used.size() - 2);
    const Keyframe &a = used[from].key, &b = used[from + 1].key;
    const double way = turns ? std::abs(b.heading - a.heading) : glm::distance(a.at, b.at);
    key.speed = way / std::max(1e-3, used[from + 1].arrived - used[from].left);
    path.keyframes.push_back(key);
  }
  return path;
}

}  // namespace terrabench::viewer
