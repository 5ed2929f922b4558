// How many bytes a clipmap has to upload, from nothing but the path of the eye (Losasso & Hoppe 2004, §3):
// what the windows of an eye there hold that those of the eye before did not. Knows no clipmap, so that what
// one reports can be held against it.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>

namespace terrabench::cross {

// The finest level shown from so far above the ground, metres: finer ones' windows are smaller than 2.5 times
// that.
inline int finest_level(double above, int window, double cell, int levels) {
  int finest = 0;
  while (finest + 1 < levels && above > 0.4 * std::ldexp(window * cell, finest)) ++finest;
  return finest;
}

class Strips {
 public:
  explicit Strips(int window) : window_(window) {}  // samples a side

  // `eye` is in samples of the ground, levels finest … levels - 1 are shown both here and before. The first
  // call gives 0: whole windows are no strips.
  std::size_t follow(glm::dvec2 eye, int finest, int levels) {
    std::size_t bytes = 0;
    for (int l = finest; l < levels && moved_; ++l) {
      // A window goes in steps of two of its samples, 2^(l+1) of the ground's.
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
