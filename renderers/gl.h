// OpenGL 4.5 with owning types for its objects; shader errors throw with the compiler's log. Only for the
// sources in renderers/; others use context.h and scene.h. A context must be current wherever an
// object is created or deleted.
#pragma once

#include <glad/gl.h>

#include <span>
#include <string_view>
#include <utility>

#include "terrain/embedded.h"
#include "terrain/error.h"

namespace terrabench {

// Loads the gl* functions of the current context. The process has one function table, so contexts of
// different libraries must not draw in two threads at the same time. Throws environment_error for OpenGL
// below 4.5.
void load_gl(GLADloadfunc get_function, std::string_view library);

// Throws environment_error if OpenGL reported an error since the last call, such as running out of memory, or
// if the context was lost: then its objects are, too.
void check_gl(std::string_view where);
Error context_lost(std::string_view where);

// Owns one OpenGL object, by the functions that create and delete `n` of its kind.
template <auto& kCreate, auto& kDelete, GLenum... kTarget>
class GlObject {
 public:
  GlObject() { kCreate(kTarget..., 1, &id_); }
  ~GlObject() {
    if (id_ != 0) kDelete(1, &id_);
  }
  GlObject(GlObject&& other) noexcept : id_(std::exchange(other.id_, 0)) {}
  GlObject& operator=(GlObject&& other) noexcept {
    std::swap(id_, other.id_);
    return *this;
  }
  GLuint id() const { return id_; }

 private:
  GLuint id_ = 0;
};

inline void create_programs(GLsizei, GLuint* id) { *id = glCreateProgram(); }
inline void delete_programs(GLsizei, const GLuint* id) { glDeleteProgram(*id); }

using Program = GlObject<create_programs, delete_programs>;
using Buffer = GlObject<glCreateBuffers, glDeleteBuffers>;
using VertexArray = GlObject<glCreateVertexArrays, glDeleteVertexArrays>;
using Renderbuffer = GlObject<glCreateRenderbuffers, glDeleteRenderbuffers>;
using Framebuffer = GlObject<glCreateFramebuffers, glDeleteFramebuffers>;
template <GLenum kTarget>
using Texture = GlObject<glCreateTextures, glDeleteTextures, kTarget>;
template <GLenum kTarget>
using Query = GlObject<glCreateQueries, glDeleteQueries, kTarget>;
using Texture1d = Texture<GL_TEXTURE_1D>;
using Texture2d = Texture<GL_TEXTURE_2D>;
using Texture2dArray = Texture<GL_TEXTURE_2D_ARRAY>;
using BufferTexture = Texture<GL_TEXTURE_BUFFER>;
using TimeQuery = Query<GL_TIME_ELAPSED>;
using PrimitiveQuery = Query<GL_PRIMITIVES_GENERATED>;

// An immutable buffer with this content.
template <class T>
Buffer make_buffer(std::span<const T> content) {
  Buffer buffer;
  glNamedBufferStorage(buffer.id(), static_cast<GLsizeiptr>(content.size_bytes()), content.data(), 0);
  return buffer;
}

// Whether anything that is drawn between begin() and end() is visible so far: passes the depth test.
class VisibleQuery {
 public:
  void begin() { glBeginQuery(GL_ANY_SAMPLES_PASSED, query_.id()); }
  void end() { glEndQuery(GL_ANY_SAMPLES_PASSED); }
  bool any() const;  // waits for the GPU

 private:
  Query<GL_ANY_SAMPLES_PASSED> query_;
};

// The shaders of renderers/shaders, built into the program (cmake/embed.cmake), by file name, which must
// exist.
using ShaderFile = EmbeddedFile;
const ShaderFile& shader_file(std::string_view name);

// Compile and link; a geometry shader is optional. A line `#include "NAME"` of a shader stands for the text
// of shader_file(NAME). Throw environment_error with the file and line of the first error and the driver's
// log.
Program link_program(const ShaderFile& vertex, const ShaderFile& fragment,
                     const ShaderFile* geometry = nullptr);
// By the files' names; "" for no geometry shader.
Program link_program(std::string_view vertex, std::string_view fragment, std::string_view geometry = "");
// Of a tessellation evaluation shader for the patches of FrameBuffers, which patch.vert and patch.tesc read.
Program link_patches(std::string_view evaluation, std::string_view fragment, std::string_view geometry = "");
Program link_compute(const ShaderFile&);

// The location of a uniform; -1, at which OpenGL ignores values, where the driver has removed the uniform
// because the picture does not depend on it. So an ink for wires may be set in a program without wires.
GLint uniform(const Program&, const char* name);

// The colour ramp of heights (ramp.h) as a texture.
Texture1d make_ramp_texture();

}  // namespace terrabench
