#include "renderers/gl.h"

#include <fmt/format.h>

#include <array>
#include <mutex>

#include "renderers/ramp.h"
#include "terrain/machine_error.h"

namespace terrabench {

namespace {

std::string_view error_text(GLenum error) {
  switch (error) {
    case GL_OUT_OF_MEMORY:
      return "OpenGL ran out of memory";
    case GL_INVALID_ENUM:
    case GL_INVALID_VALUE:
    case GL_INVALID_OPERATION:
    case GL_INVALID_FRAMEBUFFER_OPERATION:
      return "OpenGL rejected a call";
    default:
      return "OpenGL reported an error";
  }
}

}  // namespace

void load_gl(GLADloadfunc get_function, std::string_view library) {
  static std::mutex mutex;
  static GLADloadfunc loaded = nullptr;
  const std::lock_guard lock(mutex);
  if (loaded == get_function) return;
  loaded = nullptr;
  const int version = gladLoadGL(get_function);
  if (version < GLAD_MAKE_VERSION(4, 5)) {
    throw MachineError(fmt::format("OpenGL 4.5 is required, found {}.{}", GLAD_VERSION_MAJOR(version),
                                   GLAD_VERSION_MINOR(version)),
                       library, "install Mesa 22 or newer (Debian 12 has it)");
  }
  loaded = get_function;
}

Error context_lost(std::string_view where) {
  return environment_error(
      "the OpenGL context was lost: the driver reset the GPU", where,
      "run again; if it happens again, draw smaller pictures or choose --renderer osmesa");
}

void check_gl(std::string_view where) {
  const GLenum error = glGetError();
  if (error == GL_CONTEXT_LOST || glGetGraphicsResetStatus() != GL_NO_ERROR) throw context_lost(where);
  if (error == GL_NO_ERROR) return;
  // Bounded: without a current context some drivers report an error for ever.
  for (int i = 0; i < 100 && glGetError() != GL_NO_ERROR; ++i) {
  }
  throw environment_error(fmt::format("{} (0x{:04x})", error_text(error), error), where,
                          "try a smaller picture or a coarser mesh");
}

GLint uniform(const Program& program, const char* name) { return glGetUniformLocation(program.id(), name); }

bool VisibleQuery::any() const {
  GLuint answer = 0;
  glGetQueryObjectuiv(query_.id(), GL_QUERY_RESULT, &answer);
  return answer != 0;
}

Texture1d make_ramp_texture() {
  constexpr int kColors = 256;
  std::array<glm::vec3, kColors> colors;
  for (int i = 0; i < kColors; ++i) colors[i] = ramp_color(static_cast<float>(i) / (kColors - 1));
  Texture1d ramp;
  glTextureStorage1D(ramp.id(), 1, GL_RGB32F, kColors);
  glTextureSubImage1D(ramp.id(), 0, 0, kColors, GL_RGB, GL_FLOAT, colors.data());
  glTextureParameteri(ramp.id(), GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  glTextureParameteri(ramp.id(), GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  return ramp;
}

}  // namespace terrabench
