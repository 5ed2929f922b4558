// The picture that a context draws into: 4x multisampled colour and depth in a framebuffer object, so that
// every context (off-screen or window) draws through the same pixels.
#pragma once

#include "renderers/gl.h"
#include "terrain/image.h"

namespace terrabench {

class RenderTarget {
 public:
  static constexpr int kSamples = 4;
  static constexpr int kLargestSide = 16384;

  // Throws usage_error for a side outside 1…16384, environment_error when the memory for it is not there.
  RenderTarget(int width, int height);

  // Costs nothing when the size stays. The old picture is lost, and after a throw the old size is kept.
  void resize(int width, int height);
  // Draws go here from now on, over the whole picture.
  void bind() const;
  // Averages the samples and reads the picture back.
  Image read() const;

  int width() const { return width_; }
  int height() const { return height_; }

 private:
  int width_, height_;
  Renderbuffer color_, depth_, averaged_color_;
  Framebuffer drawn_, averaged_;
};

}  // namespace terrabench
