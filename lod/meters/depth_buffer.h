// A depth buffer that the meters draw into: for every pixel centre the inverse of the least depth, which is
// linear on the screen; 0 is the sky. Triangles are clipped at the near plane only. Thread-safe, and the
// result does not depend on the order of drawing. O(pixels of the triangle's box) per triangle.
#pragma once

#include <vector>

#include "lod/meters/projector.h"

namespace terrabench {

class DepthBuffer {
 public:
  explicit DepthBuffer(const View&);

  struct Vertex {
    glm::dvec3 place;
    ScreenPoint screen;
  };
  Vertex vertex(const glm::dvec3& place) const { return {place, project_(place)}; }

  void draw(const Vertex&, const Vertex&, const Vertex&);

  int width() const { return width_; }
  int height() const { return height_; }
  float at(int x, int y) const { return nearness_[static_cast<std::size_t>(y) * width_ + x]; }
  std::vector<float> take() { return std::move(nearness_); }

 private:
  void draw(const ScreenPoint&, const ScreenPoint&, const ScreenPoint&);
  void raise(int x, int y, float nearness);

  int width_, height_;
  double near_;
  Projector project_;
  std::vector<float> nearness_;
};

}  // namespace terrabench
