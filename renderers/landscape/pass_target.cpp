#include "renderers/landscape/pass_target.h"

#include <algorithm>
#include <bit>

#include "terrain/error.h"

namespace terrabench {
namespace {

GLenum layout_of(int channels) {
  return channels == 1 ? GL_RED : channels == 2 ? GL_RG : channels == 3 ? GL_RGB : GL_RGBA;
}

void clamp_to_edge(GLuint texture, GLenum filter) {
  glTextureParameteri(texture, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glTextureParameteri(texture, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  glTextureParameteri(texture, GL_TEXTURE_MIN_FILTER, static_cast<GLint>(filter));
  glTextureParameteri(texture, GL_TEXTURE_MAG_FILTER, static_cast<GLint>(filter));
}

}  // namespace

int mip_levels(int width, int height) {
  return std::bit_width(static_cast<unsigned>(std::max({width, height, 1})));
}

Texture2d repeating_texture(const Texels& texels, GLenum format) {
  Texture2d texture;
  glTextureStorage2D(texture.id(), mip_levels(texels.width, texels.height), format, texels.width,
                     texels.height);
  glTextureSubImage2D(texture.id(), 0, 0, 0, texels.width, texels.height, layout_of(texels.channels),
                      GL_FLOAT, texels.values.data());
  glGenerateTextureMipmap(texture.id());
  glTextureParameteri(texture.id(), GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
  check_gl("making a texture");
  return texture;
}

PassTarget::PassTarget(int width, int height, GLenum format, bool has_depth)
    : width_(width), height_(height) {
  if (format != 0) {
    glTextureStorage2D(color_.id(), 1, format, width, height);
    clamp_to_edge(color_.id(), GL_LINEAR);
    glNamedFramebufferTexture(framebuffer_.id(), GL_COLOR_ATTACHMENT0, color_.id(), 0);
  } else {
    glNamedFramebufferDrawBuffer(framebuffer_.id(), GL_NONE);
  }
  if (has_depth) {
    glTextureStorage2D(depth_.id(), 1, GL_DEPTH_COMPONENT32F, width, height);
    clamp_to_edge(depth_.id(), GL_NEAREST);
    glNamedFramebufferTexture(framebuffer_.id(), GL_DEPTH_ATTACHMENT, depth_.id(), 0);
  }
  check_gl("making a pass of the landscape");
  if (glCheckNamedFramebufferStatus(framebuffer_.id(), GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
    throw environment_error("OpenGL cannot draw a landscape of this size", "framebuffer",
                            "draw a smaller picture");
  }
}

void PassTarget::bind() const {
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.id());
  glViewport(0, 0, width_, height_);
}

}  // namespace terrabench
