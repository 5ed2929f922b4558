#include "viewer/input.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>
#include <cmath>
#include <glm/trigonometric.hpp>

namespace terrabench::viewer {
namespace {

constexpr double kNearSplit = 6;  // pixels
constexpr double kFast = 4;       // times as fast with Shift

}  // namespace

void Input::take(const WindowEvent& event, bool for_ground, Session& session, Controls& controls) {
  switch (event.kind) {
    case WindowEvent::Kind::kKey:
      if (!event.down) held_.erase(event.code);
      if (!event.down || !for_ground) break;
      held_.insert(event.code);
      for (const Binding& binding : bindings()) {
        if (binding.key == event.code) perform(binding.action, session, controls);
      }
      break;
    case WindowEvent::Kind::kMove:
      if (dragging_ && session.ready()) drag(event.at - controls.mouse, session, controls);
      if (splitting_)
        session.look.split = std::clamp(static_cast<float>(event.at.x / controls.window.x), 0.0F, 1.0F);
      controls.mouse = event.at;
      break;
    case WindowEvent::Kind::kButton:
      if (!event.down) dragging_ = splitting_ = false;
      if (event.down && for_ground) press(event, session, controls);
      break;
    case WindowEvent::Kind::kScroll:
      if (for_ground && session.ready()) session.camera.zoom(event.at.y);
      break;
    case WindowEvent::Kind::kDrop:
      if (!event.files.empty()) session.open(event.files.front());
      break;
    case WindowEvent::Kind::kText:
    case WindowEvent::Kind::kExposed:
      break;
  }
}

void Input::press(const WindowEvent&, Session& session, Controls& controls) {
  const double split = static_cast<double>(session.look.split) * controls.window.x;
  splitting_ = session.ready() && session.sides() > 1 && std::abs(controls.mouse.x - split) < kNearSplit;
  dragging_ = !splitting_;
  session.stop();
}

// The ground follows the mouse.
void Input::drag(const glm::dvec2& by, Session& session, const Controls& controls) const {
  Camera& camera = session.camera;
  const double tall = std::max(1, controls.window.y);
  const double degrees = camera.field_of_view / tall;
  if (camera.motion() == Motion::kPlan) {
    const double above = camera.eye().y - static_cast<double>(session.ground().bounds.low.y);
    const double metres = 2 * above * std::tan(glm::radians(0.5 * camera.field_of_view)) / tall;
    camera.move(glm::dvec3(-by.x, 0, by.y) * metres / camera.speed(), 1);
  } else if (camera.motion() == Motion::kOrbit) {
    camera.turn(2 * degrees * by.x, -2 * degrees * by.y);
  } else {
    camera.turn(-degrees * by.x, degrees * by.y);
  }
}

void Input::move(Session& session, double seconds) const {
  const auto axis = [&](int more, int less) {
    return static_cast<double>(held(more)) - static_cast<double>(held(less));
  };
  const glm::dvec3 way(axis(GLFW_KEY_D, GLFW_KEY_A), axis(GLFW_KEY_E, GLFW_KEY_Q),
                       axis(GLFW_KEY_W, GLFW_KEY_S));
  const double right = axis(GLFW_KEY_RIGHT, GLFW_KEY_LEFT), up = axis(GLFW_KEY_UP, GLFW_KEY_DOWN);
  if (!session.ready() || (way == glm::dvec3(0) && right == 0 && up == 0)) return;
  constexpr double kDegrees = 60;  // per second
  session.stop();
  session.camera.move(way * (held(GLFW_KEY_LEFT_SHIFT) || held(GLFW_KEY_RIGHT_SHIFT) ? kFast : 1), seconds);
  session.camera.turn(kDegrees * seconds * right, kDegrees * seconds * up);
}

}  // namespace terrabench::viewer
