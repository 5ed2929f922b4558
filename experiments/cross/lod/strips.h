// The bytes that a clipmap has to upload, computed from the eye's path alone (Losasso & Hoppe 2004, §3): the
// samples in the windows around an eye that were not in those around the eye before. Independent of the
// clipmap, whose reported bytes can thus be checked.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/vec2.hpp>

namespace terrabench::cross {

// The finest level shown from `above` metres over the ground: windows of finer levels are narrower than 2.5
// times that.
inline int finest_level(double above, int window, double cell, int levels) {
  int finest = 0;
  while (finest + 1 < levels && above > 0.4 * std::ldexp(window * cell, finest)) ++finest;
  return finest;
}

class Strips {
 public:
  explicit Strips(int window) : window_(window) {}  // samples per side

  // `eye` is in samples of the ground; levels finest … levels - 1 are shown here and were before. The first
  // call gives 0, since whole windows are not strips.
  std::size_t follow(glm::dvec2 eye, int finest, int levels) {
    std::size_t bytes = 0;
    for (int l = finest; l < levels && moved_; ++l) {
      // A window moves in steps of two of its samples, 2^(l+1) of the ground's.
      const double step = std::ldexp(2.0, l);
      const auto kept = [&](double now, double before) {
        const double by = 2 * std::abs(std::floor(now / step) - std::floor(before / step));
        return static_cast<std::size_t>(std::max(0.0, window_ - by));
      };
      const auto n = static_cast<std::size_t>(window_);
      bytes += 4 * (n * n - kept(eye.x, eye_.x) * kept(eye.y, eye_.y));
    }
    moved_ = true;
    eye_ = eye;
    return bytes;
  }

 private:
  int window_;
  bool moved_ = false;
  glm::dvec2 eye_{0};
};

}  // namespace terrabench::cross
