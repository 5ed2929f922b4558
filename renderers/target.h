// The picture that a context draws into: 4x multisampled colour and depth in a framebuffer object, so that
// all contexts, off-screen or window, give the same pixels.
#pragma once

#include "renderers/gl.h"
#include "terrain/image.h"

namespace terrabench {

class RenderTarget {
 public:
  static constexpr int kSamples = 4;

  // Throws usage_error for a side outside 1…16384, environment_error when there is not enough memory.
  RenderTarget(int width, int height);

  // Free when the size stays the same. Otherwise the old picture is lost; if it throws, picture and size are
  // kept.
  void resize(int width, int height);
  // Makes it the target of draw calls, with the viewport over the whole picture.
  void bind() const;
  // As bind(), of this size and with this colour everywhere, behind everything.
  void begin(int width, int height, const Rgb& background);
  // Averages the samples, as a frame that is shown needs; the two below do so themselves.
  void average() const;
  // Averages the samples and reads the picture back.
  Image read() const;
  // Averages the samples and copies columns [from, to) to the same place in the window's back buffer.
  void show(int from, int to) const;

  int width() const { return width_; }
  int height() const { return height_; }

 private:
  int width_, height_;
  Renderbuffer color_, depth_, averaged_color_;
  Framebuffer drawn_, averaged_;
};

}  // namespace terrabench
