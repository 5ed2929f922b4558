// An OpenGL 4.5 core context with a picture to draw into. One OpenGL code runs on all contexts.
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

  // What GL_RENDERER and GL_VERSION say: every picture and frame time is recorded with it. The context must
  // be current.
  std::string renderer() const;
  // The picture of this context; it can be resized.
  RenderTarget& target() { return *target_; }

 protected:
  GlContext();
  // Made by the derived constructor and given back by its destructor, while the context is current.
  std::unique_ptr<RenderTarget> target_;
};

// "osmesa" (software, no display needed). Throws environment_error when it cannot be opened, unknown_name
// for any other name, usage_error for a size outside 1…16384. The context is current on return and has a
// picture of this size. Milliseconds each, so one is kept for many pictures.
std::unique_ptr<GlContext> open_context(std::string_view name, int width, int height);

}  // namespace terrabench
