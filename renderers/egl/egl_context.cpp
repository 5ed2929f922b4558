#include "renderers/contexts.h"

// Without EGL_NO_X11, EGL's header includes Xlib, whose macros break other headers.
#define EGL_NO_X11
#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <fmt/format.h>

#include <array>
#include <optional>
#include <string_view>
#include <vector>

#include "renderers/gl.h"
#include "terrain/machine_error.h"

namespace terrabench {
namespace {

constexpr const char* kAdvice =
    "install Debian's packages libegl1 and libgl1-mesa-dri or the GPU's driver, or choose --renderer osmesa";

// The functions of EGL/egl.h that are used, and those of the extensions for devices.
struct Library {
  explicit Library(const char* path) : from(path, "EGL is not installed", kAdvice) {}

  SharedLibrary from;
  decltype(&eglQueryString) query_string = from["eglQueryString"];
  decltype(&eglInitialize) initialize = from["eglInitialize"];
  decltype(&eglBindAPI) bind_api = from["eglBindAPI"];
  decltype(&eglChooseConfig) choose_config = from["eglChooseConfig"];
  decltype(&eglCreateContext) create_context = from["eglCreateContext"];
  decltype(&eglDestroyContext) destroy_context = from["eglDestroyContext"];
  decltype(&eglMakeCurrent) make_current = from["eglMakeCurrent"];
  decltype(&eglGetError) get_error = from["eglGetError"];
  decltype(&eglGetProcAddress) get_function = from["eglGetProcAddress"];
  // Null when the extension is absent.
  PFNEGLQUERYDEVICESEXTPROC query_devices = extension("eglQueryDevicesEXT");
  PFNEGLQUERYDEVICESTRINGEXTPROC query_device_string = extension("eglQueryDeviceStringEXT");
  PFNEGLGETPLATFORMDISPLAYEXTPROC get_platform_display = extension("eglGetPlatformDisplayEXT");

 private:
  SharedLibrary::Symbol extension(const char* name) const {
    return {reinterpret_cast<void*>(get_function(name))};
  }
};

bool has_word(const char* words, std::string_view word) {
  std::string_view rest = words == nullptr ? "" : words;
  while (!rest.empty()) {
    const std::size_t end = std::min(rest.find(' '), rest.size());
    if (rest.substr(0, end) == word) return true;
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  return false;
}

// The displays to try, in order. EGL returns the same display for the same device each time.
std::vector<EGLDisplay> displays(const Library& egl, EglDevices which) {
  std::vector<EGLDisplay> gpus, software;
  const char* const known = egl.query_string(EGL_NO_DISPLAY, EGL_EXTENSIONS);
  if (egl.get_platform_display == nullptr) return {};
  if (egl.query_devices != nullptr && egl.query_device_string != nullptr &&
      has_word(known, "EGL_EXT_platform_device")) {
    std::array<EGLDeviceEXT, 64> devices{};
    EGLint count = 0;
    egl.query_devices(static_cast<EGLint>(devices.size()), devices.data(), &count);
    for (EGLint i = 0; i < count; ++i) {
      const bool on_cpu =
          has_word(egl.query_device_string(devices[i], EGL_EXTENSIONS), "EGL_MESA_device_software");
      (on_cpu ? software : gpus)
          .push_back(egl.get_platform_display(EGL_PLATFORM_DEVICE_EXT, devices[i], nullptr));
    }
  }
  if (which == EglDevices::kGpus) return gpus;
  gpus.insert(gpus.end(), software.begin(), software.end());
  if (has_word(known, "EGL_MESA_platform_surfaceless")) {
    gpus.push_back(egl.get_platform_display(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr));
  }
  return gpus;
}

struct Opened {
  EGLDisplay display = EGL_NO_DISPLAY;
  EGLContext context = EGL_NO_CONTEXT;
};

// An OpenGL 4.5 core context, if the display has one. Displays are never terminated: other contexts of the
// process may use them.
std::optional<Opened> try_display(const Library& egl, EGLDisplay display) {
  if (display == EGL_NO_DISPLAY || egl.initialize(display, nullptr, nullptr) == EGL_FALSE) return {};
  if (egl.bind_api(EGL_OPENGL_API) == EGL_FALSE) return {};
  EGLConfig config = EGL_NO_CONFIG_KHR;
  if (!has_word(egl.query_string(display, EGL_EXTENSIONS), "EGL_KHR_no_config_context")) {
    const EGLint wanted[] = {EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_SURFACE_TYPE, EGL_DONT_CARE, EGL_NONE};
    EGLint found = 0;
    if (egl.choose_config(display, wanted, &config, 1, &found) == EGL_FALSE || found == 0) return {};
  }
  // Where it is supported, a GPU that is reset reports this (check_gl) instead of drawing nothing.
  constexpr EGLint kVersion[] = {EGL_CONTEXT_MAJOR_VERSION,       4,
                                 EGL_CONTEXT_MINOR_VERSION,       5,
                                 EGL_CONTEXT_OPENGL_PROFILE_MASK, EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT};
  std::vector<EGLint> plain(std::begin(kVersion), std::end(kVersion)), robust = plain;
  plain.push_back(EGL_NONE);
  robust.insert(robust.end(),
                {EGL_CONTEXT_OPENGL_RESET_NOTIFICATION_STRATEGY, EGL_LOSE_CONTEXT_ON_RESET, EGL_NONE});
  for (const auto& attributes : {robust, plain}) {
    const EGLContext context = egl.create_context(display, config, EGL_NO_CONTEXT, attributes.data());
    if (context == EGL_NO_CONTEXT) continue;
    if (egl.make_current(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context) != EGL_FALSE) {
      egl.make_current(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
      return Opened{display, context};
    }
    egl.destroy_context(display, context);
  }
  return {};
}

class EglContext final : public GlContext {
 public:
  EglContext(const Library& egl, const Opened& opened) : egl_(egl), opened_(opened) {}
  ~EglContext() override {
    close_target();
    egl_.destroy_context(opened_.display, opened_.context);
  }

 private:
  void acquire() override {
    egl_.bind_api(EGL_OPENGL_API);
    if (egl_.make_current(opened_.display, EGL_NO_SURFACE, EGL_NO_SURFACE, opened_.context) == EGL_FALSE) {
      const EGLint error = egl_.get_error();
      if (error == EGL_CONTEXT_LOST) throw context_lost("EGL");
      throw MachineError(fmt::format("the OpenGL context cannot be made current (0x{:x})", error), "EGL",
                         "close it and open a new one");
    }
    load_gl(reinterpret_cast<GLADloadfunc>(egl_.get_function), "EGL");
  }
  void release() noexcept override {
    egl_.bind_api(EGL_OPENGL_API);
    egl_.make_current(opened_.display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
  }

  Library egl_;
  Opened opened_;
};

}  // namespace

std::unique_ptr<GlContext> open_egl(int width, int height, EglDevices devices, const char* library) {
  const Library egl(library);
  for (const EGLDisplay display : displays(egl, devices)) {
    // try_display() makes its context current for a moment, in the place of one of another library.
    GlContext::leave_current();
    if (const auto opened = try_display(egl, display)) {
      return with_target(std::make_unique<EglContext>(egl, *opened), width, height);
    }
  }
  throw MachineError(devices == EglDevices::kGpus ? "no GPU has OpenGL 4.5" : "no device has OpenGL 4.5",
                     "EGL", kAdvice);
}

}  // namespace terrabench
