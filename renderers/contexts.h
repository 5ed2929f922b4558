// The kinds of contexts behind open_context(), each of which loads its library when it is first opened.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include "renderers/context.h"

namespace terrabench {

// A library that is opened at run time, so that the program starts without it and names the package to
// install. Stays open until the process ends: Mesa keeps threads and exit handlers in its libraries. Its
// symbols are visible to this object only, because libOSMesa and libGL export the same gl* names.
class SharedLibrary {
 public:
  // `path` and `advice` must outlive the object. Throws environment_error with `missing` as what went wrong.
  SharedLibrary(const char* path, std::string_view missing, const char* advice);

  // Of any function's type.
  struct Symbol {
    void* address;
    template <class Function>
    operator Function*() const {  // NOLINT(google-explicit-constructor): initialises pointers to functions
      return reinterpret_cast<Function*>(address);
    }
  };
  // The symbol of that name; throws environment_error if the library has none.
  Symbol operator[](const char* name) const;

 private:
  const char* path_;
  const char* advice_;
  void* handle_;
};

// The context with a picture to draw into, which each of the functions below makes last; it is current then.
std::unique_ptr<GlContext> with_target(std::unique_ptr<GlContext>, int width, int height);

// Mesa's off-screen context (OSMesa): software rendering with llvmpipe, no display, GPU or X needed.
// Throws environment_error when the library is absent, or its Mesa has no OpenGL 4.5.
std::unique_ptr<GlContext> open_osmesa(int width, int height, const char* library = "libOSMesa.so.8");

// An off-screen context through EGL: on a GPU, without a display or window.
enum class EglDevices : std::uint8_t {
  kAll,   // GPUs in the driver's order, then Mesa's software device, then Mesa without any device
  kGpus,  // GPUs only
};

// Opens the first device that can be initialised and has OpenGL 4.5. GlContext::renderer() names it. Throws
// environment_error when the library is absent or there is no such device.
std::unique_ptr<GlContext> open_egl(int width, int height, EglDevices devices = EglDevices::kAll,
                                    const char* library = "libEGL.so.1");

// The GPU that open_context("auto") draws on, as GlContext::renderer() names it; empty without one. Takes
// milliseconds without a GPU, some tenths of a second with one, and leaves no context current.
std::string gpu_name();

// A hidden window through GLFW, on an X display (window.h opens visible ones). Only the main thread may open
// windows. Throws environment_error when the library is absent, there is no display, or it has no OpenGL 4.5.
std::unique_ptr<GlContext> open_glfw(int width, int height, const char* library = "libglfw.so.3");

}  // namespace terrabench
