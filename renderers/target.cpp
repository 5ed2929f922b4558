#include "renderers/target.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>

#include "renderers/context.h"
#include "renderers/ramp.h"
#include "terrain/error.h"
#include "terrain/memory.h"

namespace terrabench {
namespace {

void check_size(int width, int height) {
  constexpr int kLargest = kLargestPictureSide;
  if (width < 1 || height < 1 || width > kLargest || height > kLargest) {
    throw usage_error(fmt::format("invalid picture size {} × {}", width, height), "",
                      fmt::format("each side must be 1 to {} pixels", kLargest));
  }
  // Colour and depth of four bytes per sample, and the averaged colour.
  constexpr std::uint64_t kBytesPerPixel = 8 * RenderTarget::kSamples + 4;
  const std::uint64_t bytes =
      kBytesPerPixel * static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height);
  require_memory(bytes, fmt::format("a picture of {} x {} pixels", width, height), "draw a smaller one");
}

void require_complete(const Framebuffer& framebuffer) {
  check_gl("framebuffer");
  if (glCheckNamedFramebufferStatus(framebuffer.id(), GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
    throw environment_error("OpenGL cannot draw a picture of this size", "framebuffer", "draw a smaller one");
  }
}

}  // namespace

RenderTarget::RenderTarget(int width, int height)
    : width_((check_size(width, height), width)), height_(height) {
  glNamedRenderbufferStorageMultisample(color_.id(), kSamples, GL_RGBA8, width, height);
  glNamedRenderbufferStorageMultisample(depth_.id(), kSamples, GL_DEPTH_COMPONENT32F, width, height);
  glNamedFramebufferRenderbuffer(drawn_.id(), GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, color_.id());
  glNamedFramebufferRenderbuffer(drawn_.id(), GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth_.id());
  require_complete(drawn_);  // before allocating more: drivers report their limits here
  glNamedRenderbufferStorage(averaged_color_.id(), GL_RGBA8, width, height);
  glNamedFramebufferRenderbuffer(averaged_.id(), GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, averaged_color_.id());
  require_complete(averaged_);
}

void RenderTarget::resize(int width, int height) {
  if (width == width_ && height == height_) return;
  *this = RenderTarget(width, height);
}

void RenderTarget::bind() const {
  glBindFramebuffer(GL_FRAMEBUFFER, drawn_.id());
  glViewport(0, 0, width_, height_);
}

void RenderTarget::begin(int width, int height, const Rgb& background) {
  resize(width, height);
  bind();
  const glm::vec3 color = as_shares(background);
  glClearColor(color.r, color.g, color.b, 1);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
}

void RenderTarget::average() const {
  glBlitNamedFramebuffer(drawn_.id(), averaged_.id(), 0, 0, width_, height_, 0, 0, width_, height_,
                         GL_COLOR_BUFFER_BIT, GL_NEAREST);
}

void RenderTarget::show(int from, int to) const {
  average();
  glBlitNamedFramebuffer(averaged_.id(), 0, from, 0, to, height_, from, 0, to, height_, GL_COLOR_BUFFER_BIT,
                         GL_NEAREST);
  check_gl("showing the picture");
}

Image RenderTarget::read() const {
  average();
  Image image(width_, height_, {0, 0, 0});
  glBindFramebuffer(GL_READ_FRAMEBUFFER, averaged_.id());
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadPixels(0, 0, width_, height_, GL_RGB, GL_UNSIGNED_BYTE, image.rgb.data());
  check_gl("reading the picture");
  // OpenGL's rows are ordered from the bottom up, those of Image from the top down.
  const std::size_t row = static_cast<std::size_t>(width_) * 3;
  auto* top = image.rgb.data();
  auto* bottom = top + row * static_cast<std::size_t>(height_ - 1);
  for (; top < bottom; top += row, bottom -= row) std::swap_ranges(top, top + row, bottom);
  return image;
}

}  // namespace terrabench
