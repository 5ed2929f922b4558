#include "renderers/context.h"

#include <dlfcn.h>
#include <fmt/format.h>

#include <array>
#include <utility>

#include "renderers/contexts.h"
#include "renderers/gl.h"
#include "renderers/target.h"
#include "terrain/error.h"
#include "terrain/machine_error.h"

namespace terrabench {

SharedLibrary::SharedLibrary(const char* path, std::string_view missing, const char* advice)
    : path_(path), advice_(advice), handle_(dlopen(path, RTLD_NOW | RTLD_LOCAL)) {
  if (handle_ == nullptr) throw MachineError(missing, path, advice);
}

SharedLibrary::Symbol SharedLibrary::operator[](const char* name) const {
  void* const found = dlsym(handle_, name);
  if (found == nullptr) {
    throw MachineError(fmt::format("the library lacks the function {}", name), path_, advice_);
  }
  return {found};
}

namespace {

// Null without a GPU.
std::unique_ptr<GlContext> open_gpu(int width, int height) {
  try {
    auto context = open_egl(width, height, EglDevices::kGpus);
    if (!context->software()) return context;
  } catch (const Error& error) {
    if (error.code() != ExitCode::kEnvironment) throw;  // a wrong size is wrong for OSMesa, too
  }
  return nullptr;
}

std::unique_ptr<GlContext> open_auto(int width, int height) {
  auto gpu = open_gpu(width, height);
  return gpu != nullptr ? std::move(gpu) : open_osmesa(width, height);
}

struct ContextType {
  std::string_view name;
  std::unique_ptr<GlContext> (*open)(int width, int height);
};

// One entry per context.
constexpr ContextType kContexts[] = {
    {"osmesa", [](int width, int height) { return open_osmesa(width, height); }},
    {"egl", [](int width, int height) { return open_egl(width, height); }},
    {"glfw", [](int width, int height) { return open_glfw(width, height); }},
    {"auto", open_auto},
};

std::string text(GLenum name) {
  const auto* const value = reinterpret_cast<const char*>(glGetString(name));
  return value == nullptr ? "unknown" : value;
}

// The context that is current on this thread.
thread_local GlContext* current = nullptr;

}  // namespace

GlContext::GlContext() = default;
GlContext::~GlContext() {
  if (current == this) current = nullptr;
}

void GlContext::make_current() {
  // Contexts of another library must be released by that library. With EGL's still current, GLX ends the
  // process with an X error.
  if (current != this) leave_current();
  acquire();
  current = this;
}

void GlContext::make_current_to_delete() noexcept {
  try {
    make_current();
  } catch (const Error&) {
    // Lost: the thread has no current context now.
  }
}

void GlContext::leave_current() noexcept {
  if (current != nullptr) current->release();
  current = nullptr;
}

std::unique_ptr<GlContext> with_target(std::unique_ptr<GlContext> context, int width, int height) {
  context->make_current();
  context->target_ = std::make_unique<RenderTarget>(width, height);
  return context;
}

void GlContext::close_target() noexcept {
  make_current_to_delete();
  target_.reset();
  release();
  if (current == this) current = nullptr;
}

std::string GlContext::renderer() const {
  return fmt::format("{}, OpenGL {}", text(GL_RENDERER), text(GL_VERSION));
}

bool GlContext::software() const {
  const std::string name = text(GL_RENDERER);
  for (const std::string_view known : {"llvmpipe", "softpipe", "swrast", "Software Rasterizer"}) {
    if (name.find(known) != std::string::npos) return true;
  }
  return false;
}

std::string gpu_name() {
  const auto gpu = open_gpu(1, 1);
  return gpu == nullptr ? "" : gpu->renderer();
}

std::span<const std::string_view> context_names() {
  static const auto names = [] {
    std::array<std::string_view, std::size(kContexts)> all;
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = kContexts[i].name;
    return all;
  }();
  return names;
}

std::unique_ptr<GlContext> open_context(std::string_view name, int width, int height) {
  for (const ContextType& type : kContexts) {
    if (type.name == name) return type.open(width, height);
  }
  throw unknown_name("renderer", name, context_names());
}

}  // namespace terrabench
