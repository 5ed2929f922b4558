// An OpenGL 4.5 core context with a picture to draw into. One OpenGL code runs on all contexts.
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "terrain/image.h"

namespace terrabench {

class GlContext {
 public:
  virtual ~GlContext() = default;
  virtual void make_current() = 0;
  virtual void present() {}  // shows the frame, where there is a window
  // What GL_RENDERER and GL_VERSION say: every picture and frame time is recorded with it.
  std::string renderer() const;
};

// "osmesa" (software, no display needed). Throws environment_error when it cannot be opened, unknown_name
// otherwise. The context is current on return and draws into its own framebuffer of at least this size.
std::unique_ptr<GlContext> open_context(std::string_view name, int width, int height);

}  // namespace terrabench
