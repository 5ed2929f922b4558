#include "renderers/glfw/glfw_context.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "renderers/gl.h"
#include "renderers/shared_library.h"
#include "renderers/target.h"
#include "terrain/machine_error.h"

namespace terrabench {
namespace {

constexpr const char* kAdvice = "install Debian's package libglfw3, or choose --renderer osmesa";

// The functions of GLFW/glfw3.h that are used.
struct Library {
  decltype(&glfwInit) init;
  decltype(&glfwGetError) get_error;
  decltype(&glfwDefaultWindowHints) default_hints;
  decltype(&glfwWindowHint) hint;
  decltype(&glfwCreateWindow) create;
  decltype(&glfwDestroyWindow) destroy;
  decltype(&glfwMakeContextCurrent) make_current;
  decltype(&glfwGetProcAddress) get_function;
  decltype(&glfwSwapInterval) swap_interval;
  decltype(&glfwSwapBuffers) swap_buffers;
  decltype(&glfwPollEvents) poll_events;
  decltype(&glfwGetFramebufferSize) framebuffer_size;
};

Library load_library(const char* path) {
  const SharedLibrary library(path, "GLFW is not installed", kAdvice);
  Library glfw{};
  library.find("glfwInit", glfw.init);
  library.find("glfwGetError", glfw.get_error);
  library.find("glfwDefaultWindowHints", glfw.default_hints);
  library.find("glfwWindowHint", glfw.hint);
  library.find("glfwCreateWindow", glfw.create);
  library.find("glfwDestroyWindow", glfw.destroy);
  library.find("glfwMakeContextCurrent", glfw.make_current);
  library.find("glfwGetProcAddress", glfw.get_function);
  library.find("glfwSwapInterval", glfw.swap_interval);
  library.find("glfwSwapBuffers", glfw.swap_buffers);
  library.find("glfwPollEvents", glfw.poll_events);
  library.find("glfwGetFramebufferSize", glfw.framebuffer_size);
  return glfw;
}

// The last error of GLFW, cleared: its code and description.
std::string last_error(const Library& glfw) {
  const char* description = nullptr;
  const int code = glfw.get_error(&description);
  return fmt::format("0x{:x}: {}", code, description == nullptr ? "no description" : description);
}

class GlfwContext final : public GlContext {
 public:
  GlfwContext(const Library& glfw, GLFWwindow* window, int width, int height) : glfw_(glfw), window_(window) {
    try {
      open_target(width, height);
      glfw_.swap_interval(0);  // no waiting for the display's refresh
    } catch (...) {
      close();
      throw;
    }
  }
  ~GlfwContext() override { close(); }

  void present() override {
    make_current();
    int width = 0, height = 0;
    glfw_.framebuffer_size(window_, &width, &height);
    target().show(width, height);
    glfw_.swap_buffers(window_);
    glfw_.poll_events();
  }

 private:
  void acquire() override {
    glfw_.get_error(nullptr);
    glfw_.make_current(window_);
    const char* description = nullptr;
    if (glfw_.get_error(&description) != GLFW_NO_ERROR) {
      throw MachineError(fmt::format("the window's OpenGL context cannot be used: {}", description), "GLFW",
                         "close it and open a new one");
    }
    load_gl(reinterpret_cast<GLADloadfunc>(glfw_.get_function), "GLFW");
  }
  void release() noexcept override { glfw_.make_current(nullptr); }
  void close() {
    close_target();
    glfw_.destroy(window_);
  }

  Library glfw_;
  GLFWwindow* window_;
};

GLFWwindow* create_window(const Library& glfw, int width, int height, bool visible) {
  glfw.default_hints();
  glfw.hint(GLFW_CONTEXT_VERSION_MAJOR, 4);
  glfw.hint(GLFW_CONTEXT_VERSION_MINOR, 5);
  glfw.hint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
  glfw.hint(GLFW_CONTEXT_ROBUSTNESS, GLFW_LOSE_CONTEXT_ON_RESET);
  glfw.hint(GLFW_VISIBLE, visible ? GLFW_TRUE : GLFW_FALSE);
  glfw.hint(GLFW_FOCUS_ON_SHOW, GLFW_FALSE);
  glfw.hint(GLFW_DEPTH_BITS, 0);  // RenderTarget has its own depth
  glfw.hint(GLFW_STENCIL_BITS, 0);
  // A hidden window needs no pixels of its own.
  constexpr int kHidden = 16;
  const auto side = [&](int wanted) {
    return visible ? std::clamp(wanted, 1, kLargestPictureSide) : kHidden;
  };
  return glfw.create(side(width), side(height), "terrabench", nullptr, nullptr);
}

}  // namespace

std::unique_ptr<GlContext> open_glfw(int width, int height, bool visible, const char* library) {
  const Library glfw = load_library(library);
  // Never terminated: GLFW counts no users, and Mesa's modules do not survive unloading.
  if (glfw.init() == GLFW_FALSE) {
    throw MachineError(
        fmt::format("no window can be opened ({})", last_error(glfw)), "GLFW",
        "set DISPLAY, start the program under xvfb-run (Debian's packages xvfb and xauth), or choose "
        "--renderer egl or osmesa");
  }
  GlContext::leave_current();  // GLX makes its new context current for a moment
  GLFWwindow* const window = create_window(glfw, width, height, visible);
  if (window == nullptr) {
    throw MachineError(fmt::format("the display has no OpenGL 4.5 ({})", last_error(glfw)), "GLFW",
                       "install Debian's packages libgl1 and libgl1-mesa-dri or the GPU's driver, or "
                       "choose --renderer egl or osmesa");
  }
  return std::make_unique<GlfwContext>(glfw, window, width, height);
}

}  // namespace terrabench
