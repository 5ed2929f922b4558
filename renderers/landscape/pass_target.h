// OpenGL textures and framebuffers that passes of a landscape write and others read. Only for renderers/.
#pragma once

#include "renderers/gl.h"
#include "renderers/landscape/textures.h"

namespace terrabench {

using TextureArray = Texture<GL_TEXTURE_2D_ARRAY>;

// Levels of detail of a picture of this size, down to one texel.
int mip_levels(int width, int height);
// Mip-mapped, repeating; stored as `format`, such as GL_RGBA16F.
Texture2d repeating_texture(const Texels&, GLenum format);

// Colour of `format`, none if 0, and depth as textures. Throws environment_error.
class PassTarget {
 public:
  PassTarget(int width, int height, GLenum format, bool has_depth = true);
  void bind() const;  // as the target of draw calls, with the viewport over it
  int width() const { return width_; }
  int height() const { return height_; }
  GLuint color() const { return color_.id(); }
  GLuint depth() const { return depth_.id(); }

 private:
  int width_, height_;
  Texture2d color_, depth_;
  Framebuffer framebuffer_;
};

}  // namespace terrabench
