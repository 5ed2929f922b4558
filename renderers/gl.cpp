#include "renderers/gl.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <mutex>
#include <optional>
#include <string>

#include "terrain/error.h"

namespace terrabench {

std::span<const EmbeddedFile> embedded_shaders();

namespace {

// Owned until the program is linked; OpenGL keeps what an attached shader still needs.
class Shader {
 public:
  Shader(GLenum stage, const ShaderFile& file) : id_(glCreateShader(stage)) {
    const char* const text = file.text.data();
    const auto length = static_cast<GLint>(file.text.size());
    glShaderSource(id_, 1, &text, &length);
    glCompileShader(id_);
    GLint good = 0, log_size = 0;
    glGetShaderiv(id_, GL_COMPILE_STATUS, &good);
    if (good != 0) return;
    glGetShaderiv(id_, GL_INFO_LOG_LENGTH, &log_size);
    std::string log(static_cast<std::size_t>(log_size), '\0');
    glGetShaderInfoLog(id_, log_size, &log_size, log.data());
    log.resize(static_cast<std::size_t>(log_size));
    glDeleteShader(id_);
    throw environment_error(fmt::format("the shader does not compile: {}", log), file.name,
                            "report it with the OpenGL renderer that the results' provenance names");
  }
  ~Shader() { glDeleteShader(id_); }
  Shader(const Shader&) = delete;
  Shader& operator=(const Shader&) = delete;
  GLuint id() const { return id_; }

 private:
  GLuint id_;
};

std::string_view error_text(GLenum error) {
  switch (error) {
    case GL_OUT_OF_MEMORY:
      return "OpenGL ran out of memory";
    case GL_INVALID_ENUM:
    case GL_INVALID_VALUE:
    case GL_INVALID_OPERATION:
    case GL_INVALID_FRAMEBUFFER_OPERATION:
      return "OpenGL refused a call";
    default:
      return "OpenGL met an error";
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
    throw environment_error(fmt::format("OpenGL 4.5 is needed, and this is {}.{}",
                                        GLAD_VERSION_MAJOR(version), GLAD_VERSION_MINOR(version)),
                            library, "install Mesa 22 or newer (Debian 12 has it)");
  }
  loaded = get_function;
}

void check_gl(std::string_view where) {
  const GLenum error = glGetError();
  if (error == GL_NO_ERROR) return;
  while (glGetError() != GL_NO_ERROR) {
  }
  throw environment_error(fmt::format("{} (0x{:04x})", error_text(error), error), where,
                          "try a smaller picture or a coarser mesh");
}

GLuint BufferKind::create() {
  GLuint id = 0;
  glCreateBuffers(1, &id);
  return id;
}

GLuint VertexArrayKind::create() {
  GLuint id = 0;
  glCreateVertexArrays(1, &id);
  return id;
}

GLuint RenderbufferKind::create() {
  GLuint id = 0;
  glCreateRenderbuffers(1, &id);
  return id;
}

GLuint FramebufferKind::create() {
  GLuint id = 0;
  glCreateFramebuffers(1, &id);
  return id;
}

GLuint Texture1dKind::create() {
  GLuint id = 0;
  glCreateTextures(GL_TEXTURE_1D, 1, &id);
  return id;
}

GLuint BufferTextureKind::create() {
  GLuint id = 0;
  glCreateTextures(GL_TEXTURE_BUFFER, 1, &id);
  return id;
}

const ShaderFile& shader_file(std::string_view name) {
  const auto files = embedded_shaders();
  const auto found = std::find_if(files.begin(), files.end(), [&](const ShaderFile& file) {
    return file.name.substr(file.name.rfind('/') + 1) == name;
  });
  assert(found != files.end());
  return *found;
}

Program link_program(const ShaderFile& vertex, const ShaderFile& fragment, const ShaderFile* geometry) {
  const Shader first(GL_VERTEX_SHADER, vertex), last(GL_FRAGMENT_SHADER, fragment);
  std::optional<Shader> between;
  if (geometry != nullptr) between.emplace(GL_GEOMETRY_SHADER, *geometry);
  Program program;
  glAttachShader(program.id(), first.id());
  if (between) glAttachShader(program.id(), between->id());
  glAttachShader(program.id(), last.id());
  glLinkProgram(program.id());
  GLint good = 0, log_size = 0;
  glGetProgramiv(program.id(), GL_LINK_STATUS, &good);
  if (good == 0) {
    glGetProgramiv(program.id(), GL_INFO_LOG_LENGTH, &log_size);
    std::string log(static_cast<std::size_t>(log_size), '\0');
    glGetProgramInfoLog(program.id(), log_size, &log_size, log.data());
    log.resize(static_cast<std::size_t>(log_size));
    throw environment_error(fmt::format("the shaders do not link: {}", log),
                            fmt::format("{} and {}", vertex.name, fragment.name),
                            "report it with the OpenGL renderer that the results' provenance names");
  }
  glDetachShader(program.id(), first.id());
  if (between) glDetachShader(program.id(), between->id());
  glDetachShader(program.id(), last.id());
  return program;
}

GLint uniform(const Program& program, const char* name) {
  const GLint location = glGetUniformLocation(program.id(), name);
  assert(location >= 0);
  return location;
}

}  // namespace terrabench
