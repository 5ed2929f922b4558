// A window on an X display, through GLFW. Pictures are drawn off-screen as in every other context, and then
// copied into the window, so that what is seen is what `render` writes. What the user does arrives as values,
// so that a script can do the same.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "renderers/context.h"
#include "terrain/image.h"

namespace terrabench {

// kExposed: the display has lost what the window showed, or its size has changed.
struct WindowEvent {
  enum class Kind : std::uint8_t { kKey, kText, kMove, kButton, kScroll, kDrop, kExposed } kind = Kind::kKey;
  // A key or mouse button by GLFW's number (letters and digits: their ASCII capital), or of a text the
  // character's Unicode number. A key that is held is reported once.
  int code = 0;
  bool down = false;  // of a key or button
  glm::dvec2 at{0};   // the mouse in pixels from the top left corner; of a scroll: its steps
  std::vector<std::string> files = {};  // paths dropped on the window
};

// Used on the main thread only.
class Window : public GlContext {
 public:
  // What happened since the last call, in order. Waits for something to happen, but at most so many seconds.
  virtual std::vector<WindowEvent> events(double wait = 0) = 0;
  virtual bool closing() const = 0;     // the user has asked to close it
  virtual glm::ivec2 size() const = 0;  // pixels; 0 × 0 while it is minimised
  virtual void resize(glm::ivec2 size) = 0;
  virtual void set_title(const std::string&) = 0;
  virtual std::string clipboard() const = 0;
  virtual void set_clipboard(const std::string&) = 0;

  // Copies columns [from, to) of the context's picture to the same place in the window.
  void show(int from, int to);
  void clear(const Rgb&);  // instead of a picture
  void bind();             // as the target of draw calls, for what is drawn over the picture
  // Shows what was drawn; waits for the display's refresh where there is one.
  virtual void swap() = 0;
};

// Throws environment_error when GLFW is absent, there is no display, or it has no OpenGL 4.5.
std::unique_ptr<Window> open_window(glm::ivec2 size, std::string_view title,
                                    const char* library = "libglfw.so.3");

}  // namespace terrabench
