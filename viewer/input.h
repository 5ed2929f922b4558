// Turns the window's events into motion of the camera and into actions.
#pragma once

#include <set>

#include "renderers/window.h"
#include "viewer/actions.h"

namespace terrabench::viewer {

class Input {
 public:
  // `for_ground`: whether the event is for the ground, and not for a panel. A key or button that is released
  // is released everywhere.
  void take(const WindowEvent&, bool for_ground, Session&, Controls&);
  // Moves the camera by the keys that are held.
  void move(Session&, double seconds) const;
  bool idle() const { return held_.empty() && !dragging_ && !splitting_; }

 private:
  void press(const WindowEvent&, Session&, Controls&);
  void drag(const glm::dvec2& by, Session&, const Controls&) const;
  bool held(int key) const { return held_.contains(key); }

  std::set<int> held_;
  bool dragging_ = false, splitting_ = false;
};

}  // namespace terrabench::viewer
