// An OpenGL 4.5 core context with a picture to draw into. The same OpenGL code runs on all contexts, and
// contexts of different kinds may exist beside each other.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <string_view>

namespace terrabench {

class RenderTarget;

// Of a context's picture, pixels: the largest texture that every OpenGL 4.5 offers.
inline constexpr int kLargestPictureSide = 16384;

// Used and destroyed on the thread that opened it.
class GlContext {
 public:
  virtual ~GlContext();
  GlContext(const GlContext&) = delete;
  GlContext& operator=(const GlContext&) = delete;

  // Takes the place of the thread's current context. Throws environment_error if the context was lost.
  void make_current();

  // Before objects of this context are deleted: makes it current, or, if it was lost, leaves the thread
  // without a current context, so that deleting them does nothing.
  void make_current_to_delete() noexcept;
  // Leaves the thread without a current context.
  static void leave_current() noexcept;

  // GL_RENDERER and GL_VERSION, recorded with every picture and frame time. The context must be current.
  std::string renderer() const;
  // Whether the processor draws (Mesa's llvmpipe or softpipe). The context must be current.
  bool software() const;
  RenderTarget& target() { return *target_; }

 protected:
  GlContext();
  virtual void acquire() = 0;           // makes it current and loads its functions; throws if that fails
  virtual void release() noexcept = 0;  // leaves the thread without a current context

  // To be called by the derived destructor before the context is destroyed.
  void close_target() noexcept;

 private:
  friend std::unique_ptr<GlContext> with_target(std::unique_ptr<GlContext>, int width, int height);
  std::unique_ptr<RenderTarget> target_;
};

// `name` is one of:
//   osmesa  Mesa's software renderer; needs neither display nor GPU
//   egl     the first GPU that has OpenGL 4.5; without one, Mesa's software renderer
//   glfw    a hidden window; needs an X display
//   auto    egl if that finds a GPU, otherwise osmesa
// Throws unknown_name for any other, environment_error when it cannot be opened (the message says what to
// install), usage_error for a side outside 1…16384. On return the context is current and has a picture of
// this size. Takes milliseconds; use one context for many pictures.
std::unique_ptr<GlContext> open_context(std::string_view name, int width, int height);

std::span<const std::string_view> context_names();  // those above, in this order

}  // namespace terrabench
