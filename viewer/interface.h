// Dear ImGui over the picture: takes the window's events and draws what was built between begin() and end().
#pragma once

#include <array>
#include <glm/vec2.hpp>

#include "renderers/window.h"

namespace terrabench::viewer {

// One per process. The window must outlive it.
class Interface {
 public:
  explicit Interface(Window&);
  ~Interface();
  Interface(const Interface&) = delete;
  Interface& operator=(const Interface&) = delete;

  void take(const WindowEvent&);
  // Whether the mouse is over a panel or a text is being typed: such events are not for the ground.
  bool takes_mouse() const;
  bool takes_keys() const;

  // `seconds` since the frame before, > 0.
  void begin(glm::ivec2 size, double seconds);
  void end();  // draws into the window

 private:
  Window& window_;
  // A click may be shorter than a frame.
  std::array<bool, 3> down_{}, pressed_{};
};

}  // namespace terrabench::viewer
