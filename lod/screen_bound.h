// How large a vertical error may be without showing as more than so many pixels: what methods with a bound
// choose their detail by.
//
// A point at depth w along the line of sight and at horizontal distance ρ from the eye that is off by e
// vertically moves by f·e·ρ / (w·w') pixels on the screen, f the focal length in pixels and w' the depth of
// the moved point, w' ≥ w - e·|sin pitch|. The bound is that, with the least w and the greatest ρ of what a
// box shows in the frustum: strict for any camera, where de Boer (2000, §2.3.1) takes the camera to look
// level and the distance to be the patch's middle's. O(1) a box, a few of them at a time.
#pragma once

#include <array>
#include <cstddef>
#include <glm/vec3.hpp>
#include <vector>

#include "terrain/view.h"

namespace terrabench {

// Many boxes, each coordinate in an array of its own.
struct Boxes {
  std::array<std::vector<float>, 3> low, high;  // x, y, z; metres
};

class ScreenBound {
 public:
  // For errors of at most `pixels`, over 0.
  ScreenBound(const View&, double pixels);

  // Metres that anything in each of the boxes first … last - 1 may be off, up or down; into the same places
  // of `metres`.
  void allow(const Boxes&, std::size_t first, std::size_t last, float* metres) const;
  // De Boer's: metres for patches around the boxes' middles.
  void allow_level_camera(const Boxes&, std::size_t first, std::size_t last, float* metres) const;

 private:
  glm::dvec3 eye_, forward_;
  double pixels_, focal_, near_;
  double secant_;  // of the angle between the line of sight and a corner of the screen
};

}  // namespace terrabench
