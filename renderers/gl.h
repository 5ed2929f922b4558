// OpenGL 4.5 with owners for its objects: what is created is deleted, and a shader that does not compile
// throws with the compiler's log. For renderers' sources only; others see context.h and relief.h. A context
// must be current wherever an object is created or deleted.
#pragma once

#include <glad/gl.h>

#include <span>
#include <string_view>
#include <utility>

#include "terrain/embedded.h"

namespace terrabench {

// Points the gl* functions at the current context's. One table serves the process: contexts of different
// libraries may take turns, but not draw at the same time in two threads. Throws environment_error below 4.5.
void load_gl(GLADloadfunc get_function, std::string_view library);

// Throws environment_error when OpenGL has met an error since the last call, such as running out of memory.
void check_gl(std::string_view where);

// Owns one object; Kind says how it is made and deleted.
template <class Kind>
class GlObject {
 public:
  GlObject() : id_(Kind::create()) {}
  ~GlObject() {
    if (id_ != 0) Kind::destroy(id_);
  }
  GlObject(GlObject&& other) noexcept : id_(std::exchange(other.id_, 0)) {}
  GlObject& operator=(GlObject&& other) noexcept {
    std::swap(id_, other.id_);
    return *this;
  }
  GLuint id() const { return id_; }

 private:
  GLuint id_;
};

struct BufferKind {
  static GLuint create();
  static void destroy(GLuint id) { glDeleteBuffers(1, &id); }
};
struct VertexArrayKind {
  static GLuint create();
  static void destroy(GLuint id) { glDeleteVertexArrays(1, &id); }
};
struct RenderbufferKind {
  static GLuint create();
  static void destroy(GLuint id) { glDeleteRenderbuffers(1, &id); }
};
struct FramebufferKind {
  static GLuint create();
  static void destroy(GLuint id) { glDeleteFramebuffers(1, &id); }
};
struct Texture1dKind {
  static GLuint create();
  static void destroy(GLuint id) { glDeleteTextures(1, &id); }
};
struct BufferTextureKind {
  static GLuint create();
  static void destroy(GLuint id) { glDeleteTextures(1, &id); }
};
struct ProgramKind {
  static GLuint create() { return glCreateProgram(); }
  static void destroy(GLuint id) { glDeleteProgram(id); }
};

using Buffer = GlObject<BufferKind>;
using VertexArray = GlObject<VertexArrayKind>;
using Renderbuffer = GlObject<RenderbufferKind>;
using Framebuffer = GlObject<FramebufferKind>;
using Texture1d = GlObject<Texture1dKind>;
using BufferTexture = GlObject<BufferTextureKind>;
using Program = GlObject<ProgramKind>;

// A buffer that is written once.
template <class T>
Buffer make_buffer(std::span<const T> content) {
  Buffer buffer;
  glNamedBufferStorage(buffer.id(), static_cast<GLsizeiptr>(content.size_bytes()), content.data(), 0);
  return buffer;
}

// The shaders of renderers/shaders, built into the program (cmake/embed.cmake), by file name, which must
// exist.
using ShaderFile = EmbeddedFile;
const ShaderFile& shader_file(std::string_view name);

// Compiles and links; a geometry shader is optional. Throws environment_error with the file's name and the
// driver's log.
Program link_program(const ShaderFile& vertex, const ShaderFile& fragment,
                     const ShaderFile* geometry = nullptr);

// Where a uniform lives; it must be in use.
GLint uniform(const Program&, const char* name);

}  // namespace terrabench
