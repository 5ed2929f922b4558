#include "renderers/contexts.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <fmt/format.h>

#include <glm/common.hpp>
#include <string>
#include <utility>

#include "renderers/gl.h"
#include "renderers/ramp.h"
#include "renderers/target.h"
#include "renderers/window.h"
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
  decltype(&glfwWaitEventsTimeout) wait_events = from["glfwWaitEventsTimeout"];
  decltype(&glfwGetFramebufferSize) framebuffer_size = from["glfwGetFramebufferSize"];
  decltype(&glfwSetWindowSize) set_size = from["glfwSetWindowSize"];
  decltype(&glfwSetWindowTitle) set_title = from["glfwSetWindowTitle"];
  decltype(&glfwWindowShouldClose) should_close = from["glfwWindowShouldClose"];
  decltype(&glfwGetClipboardString) clipboard = from["glfwGetClipboardString"];
  decltype(&glfwSetClipboardString) set_clipboard = from["glfwSetClipboardString"];
  decltype(&glfwSetWindowUserPointer) set_user = from["glfwSetWindowUserPointer"];
  decltype(&glfwGetWindowUserPointer) user = from["glfwGetWindowUserPointer"];
  decltype(&glfwSetKeyCallback) on_key = from["glfwSetKeyCallback"];
  decltype(&glfwSetCharCallback) on_text = from["glfwSetCharCallback"];
  decltype(&glfwSetCursorPosCallback) on_move = from["glfwSetCursorPosCallback"];
  decltype(&glfwSetMouseButtonCallback) on_button = from["glfwSetMouseButtonCallback"];
  decltype(&glfwSetScrollCallback) on_scroll = from["glfwSetScrollCallback"];
  decltype(&glfwSetDropCallback) on_drop = from["glfwSetDropCallback"];
  decltype(&glfwSetWindowRefreshCallback) on_exposed = from["glfwSetWindowRefreshCallback"];
};

// The last error of GLFW, cleared: its code and description.
std::string last_error(const Library& glfw) {
  const char* description = nullptr;
  const int code = glfw.get_error(&description);
  return fmt::format("0x{:x}: {}", code, description == nullptr ? "no description" : description);
}

class GlfwWindow final : public Window {
 public:
  GlfwWindow(const Library& glfw, GLFWwindow* window) : glfw_(glfw), window_(window) {}
  ~GlfwWindow() override {
    close_target();
    glfw_.destroy(window_);
  }

  std::vector<WindowEvent> events(double wait) override {
    if (wait > 0) {
      glfw_.wait_events(wait);
    } else {
      glfw_.poll_events();
    }
    return std::exchange(events_, {});
  }
  bool closing() const override { return glfw_.should_close(window_) != GLFW_FALSE; }
  glm::ivec2 size() const override {
    glm::ivec2 size(0);
    glfw_.framebuffer_size(window_, &size.x, &size.y);
    return size;
  }
  void resize(glm::ivec2 size) override { glfw_.set_size(window_, size.x, size.y); }
  void set_title(const std::string& title) override { glfw_.set_title(window_, title.c_str()); }
  std::string clipboard() const override {
    const char* const text = glfw_.clipboard(window_);
    return text == nullptr ? "" : text;
  }
  void set_clipboard(const std::string& text) override { glfw_.set_clipboard(window_, text.c_str()); }
  void swap() override { glfw_.swap_buffers(window_); }

  // To be called once its address is final.
  void listen() {
    user_of = glfw_.user;
    glfw_.set_user(window_, this);
    glfw_.on_key(window_, [](GLFWwindow* window, int key, int, int action, int) {
      if (key != GLFW_KEY_UNKNOWN && action != GLFW_REPEAT)
        add(window, {.kind = WindowEvent::Kind::kKey, .code = key, .down = action == GLFW_PRESS});
    });
    glfw_.on_text(window_, [](GLFWwindow* window, unsigned character) {
      add(window, {.kind = WindowEvent::Kind::kText, .code = static_cast<int>(character)});
    });
    glfw_.on_move(window_, [](GLFWwindow* window, double x, double y) {
      add(window, {.kind = WindowEvent::Kind::kMove, .at = {x, y}});
    });
    glfw_.on_button(window_, [](GLFWwindow* window, int button, int action, int) {
      add(window, {.kind = WindowEvent::Kind::kButton, .code = button, .down = action == GLFW_PRESS});
    });
    glfw_.on_scroll(window_, [](GLFWwindow* window, double x, double y) {
      add(window, {.kind = WindowEvent::Kind::kScroll, .at = {x, y}});
    });
    glfw_.on_exposed(window_, [](GLFWwindow* window) { add(window, {.kind = WindowEvent::Kind::kExposed}); });
    glfw_.on_drop(window_, [](GLFWwindow* window, int count, const char** paths) {
      add(window, {.kind = WindowEvent::Kind::kDrop, .files = {paths, paths + count}});
    });
  }

 private:
  static void add(GLFWwindow* window, WindowEvent event) {
    static_cast<GlfwWindow*>(user_of(window))->events_.push_back(std::move(event));
  }

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

  // A callback receives nothing but the window.
  static inline decltype(&glfwGetWindowUserPointer) user_of = nullptr;

  Library glfw_;
  GLFWwindow* window_;
  std::vector<WindowEvent> events_;
};

void set_hints(const Library& glfw, bool visible) {
  glfw.default_hints();
  glfw.hint(GLFW_CONTEXT_VERSION_MAJOR, 4);
  glfw.hint(GLFW_CONTEXT_VERSION_MINOR, 5);
  glfw.hint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
  glfw.hint(GLFW_CONTEXT_ROBUSTNESS, GLFW_LOSE_CONTEXT_ON_RESET);
  glfw.hint(GLFW_VISIBLE, visible ? GLFW_TRUE : GLFW_FALSE);
  glfw.hint(GLFW_DEPTH_BITS, 0);  // RenderTarget has its own depth
  glfw.hint(GLFW_STENCIL_BITS, 0);
}

// A window of that size with a picture of its own.
std::unique_ptr<GlfwWindow> open(const char* library, glm::ivec2 window_size, glm::ivec2 picture,
                                 const std::string& title, bool visible) {
  const Library glfw(library);
  // Never terminated: GLFW counts no users, and Mesa's modules do not survive unloading.
  if (glfw.init() == GLFW_FALSE) {
    throw MachineError(
        fmt::format("no window can be opened ({})", last_error(glfw)), "GLFW",
        "set DISPLAY, start the program under xvfb-run (Debian's packages xvfb and xauth), or choose "
        "--renderer egl or osmesa");
  }
  GlContext::leave_current();  // GLX makes its new context current for a moment
  set_hints(glfw, visible);
  GLFWwindow* const window = glfw.create(window_size.x, window_size.y, title.c_str(), nullptr, nullptr);
  if (window == nullptr) {
    throw MachineError(fmt::format("the display has no OpenGL 4.5 ({})", last_error(glfw)), "GLFW",
                       "install Debian's packages libgl1 and libgl1-mesa-dri or the GPU's driver, or "
                       "choose --renderer egl or osmesa");
  }
  auto context = with_target(std::make_unique<GlfwWindow>(glfw, window), picture.x, picture.y);
  glfw.swap_interval(visible ? 1 : 0);
  return std::unique_ptr<GlfwWindow>(static_cast<GlfwWindow*>(context.release()));
}

}  // namespace

void Window::bind() {
  make_current();
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
}

void Window::show(int from, int to) {
  make_current();
  target().show(from, to);
}

void Window::clear(const Rgb& colour) {
  const glm::vec3 shares = as_shares(colour);
  bind();
  glClearColor(shares.r, shares.g, shares.b, 1);
  glClear(GL_COLOR_BUFFER_BIT);
}

std::unique_ptr<GlContext> open_glfw(int width, int height, const char* library) {
  constexpr glm::ivec2 kHidden(16);  // it needs no pixels of its own
  return open(library, kHidden, {width, height}, "terrabench", false);
}

std::unique_ptr<Window> open_window(glm::ivec2 size, std::string_view title, const char* library) {
  size = glm::clamp(size, glm::ivec2(1), glm::ivec2(kLargestPictureSide));
  std::unique_ptr<GlfwWindow> window = open(library, size, size, std::string(title), true);
  window->listen();
  return window;
}

}  // namespace terrabench
