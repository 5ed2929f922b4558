// An OpenGL 4.5 core context with a picture to draw into. The same OpenGL code runs on all contexts.
#pragma once

#include <memory>
#include <string>
#include <string_view>

namespace terrabench {

class RenderTarget;

class GlContext {
 public:
  virtual ~GlContext();
  GlContext(const GlContext&) = delete;
  GlContext& operator=(const GlContext&) = delete;

  virtual void make_current() = 0;
  virtual void present() {}  // shows the frame, where there is a window

  // GL_RENDERER and GL_VERSION, recorded with every picture and frame time. The context must be current.
  std::string renderer() const;
  RenderTarget& target() { return *target_; }

 protected:
  GlContext();
  // Created by the derived constructor and released by its destructor, while the context is current.
  std::unique_ptr<RenderTarget> target_;
};

// `name`: "osmesa" (software, needs no display). Throws unknown_name for any other, environment_error when it
// cannot be opened, usage_error for a side outside 1…16384. On return the context is current and has a
// picture of this size. Takes milliseconds; use one context for many pictures.
std::unique_ptr<GlContext> open_context(std::string_view name, int width, int height);

}  // namespace terrabench
