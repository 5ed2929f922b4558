// The largest vertical error in a box that stays within a given number of pixels: methods with an error bound
// choose their detail by it.
//
// Consider a point at depth w along the line of sight and horizontal distance ρ from the eye. A vertical
// error e moves it by f·e·ρ / (w·w') pixels, where f is the focal length in pixels and w' ≥ w - e·|sin pitch|
// the depth of the moved point. The bound uses the least w and the greatest ρ in the part of a box inside the
// frustum, so it is strict for any camera; de Boer (2000, §2.3.1) assumes a level camera and uses the
// distance to the patch's middle. O(1) per box, vectorised.
#pragma once

#include <array>
#include <cstddef>
#include <glm/vec3.hpp>
#include <vector>

#include "terrain/solid.h"
#include "terrain/split_rule.h"
#include "terrain/view.h"

namespace terrabench {

// Many boxes, one array per coordinate.
struct Boxes {
  std::array<std::vector<float>, 3> low, high;  // x, y, z; metres
};

class ScreenBound {
 public:
  // `pixels`: the allowed screen-space error, > 0.
  ScreenBound(const View&, double pixels);

  // Writes the allowed vertical error, metres, in boxes first … last - 1 to metres[first … last - 1].
  void allow(const Boxes&, std::size_t first, std::size_t last, float* metres) const;
  float allow(const Bounds&) const;
  // Likewise in a ball. At most as much as in a ball inside it, in spite of rounding, if the inner ball keeps
  // 1e-7 of the outer radius away from the outer surface.
  double allow(const glm::dvec3& centre, double radius) const;
  // Metres that the given pixels span across the line of sight, at the ball's least depth.
  double length(const glm::dvec3& centre, double radius) const {
    return pixels_ * least_depth(centre - eye_, radius) / focal_;
  }
  // What allow() in a ball is computed from.
  BoundTerms terms() const { return {eye_, forward_, pixels_, focal_, near_, secant_}; }
  // Likewise by de Boer's rule, for the middles of the boxes.
  void allow_level_camera(const Boxes&, std::size_t first, std::size_t last, float* metres) const;

 private:
  float allow_in(float low_x, float high_x, float low_y, float high_y, float low_z, float high_z) const;
  double least_depth(const glm::dvec3& off, double radius) const;

  glm::dvec3 eye_, forward_;
  double pixels_, focal_, near_;
  double secant_;  // of the angle between the line of sight and a corner of the screen
};

}  // namespace terrabench
