#include "renderers/contexts.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "renderers/gl.h"
#include "renderers/target.h"
#include "terrain/machine_error.h"

namespace terrabench {
namespace {

constexpr const char* kAdvice = "install Debian's package libglfw3, or choose --renderer osmesa";

// The functions of GLFW/glfw3.h that are used.
struct Library {
  explicit Library(const char* path) : from(path, "GLFW is not installed", kAdvice) {}

  SharedLibrary from;
  decltype(&glfwInit) init = from["glfwInit"];
  decltype(&glfwGetError) get_error = from["glfwGetError"];
  decltype(&glfwDefaultWindowHints) default_hints = from["glfwDefaultWindowHints"];
  decltype(&glfwWindowHint) hint = from["glfwWindowHint"];
  decltype(&glfwCreateWindow) create = from["glfwCreateWindow"];
  decltype(&glfwDestroyWindow) destroy = from["glfwDestroyWindow"];
  decltype(&glfwMakeContextCurrent) make_current = from["glfwMakeContextCurrent"];
  decltype(&glfwGetProcAddress) get_function = from["glfwGetProcAddress"];
  decltype(&glfwSwapInterval) swap_interval = from["glfwSwapInterval"];
  decltype(&glfwSwapBuffers) swap_buffers = from["glfwSwapBuffers"];
  decltype(&glfwPollEvents) poll_events = from["glfwPollEvents"];
  decltype(&glfwGetFramebufferSize) framebuffer_size = from["glfwGetFramebufferSize"];
};

// The last error of GLFW, cleared: its code and description.
std::string last_error(const Library& glfw) {
  const char* description = nullptr;
  const int code = glfw.get_error(&description);
  return fmt::format("0x{:x}: {}", code, description == nullptr ? "no description" : description);
}

class GlfwContext final : public GlContext {
 public:
  GlfwContext(const Library& glfw, GLFWwindow* window) : glfw_(glfw), window_(window) {}
  ~GlfwContext() override {
    close_target();
    glfw_.destroy(window_);
  }

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
  const Library glfw(library);
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
  auto context = with_target(std::make_unique<GlfwContext>(glfw, window), width, height);
  glfw.swap_interval(0);  // no waiting for the display's refresh
  return context;
}

}  // namespace terrabench
