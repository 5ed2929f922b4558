// Where points fall on a view's screen, in pixels and in double precision: the meters' one measure of the
// screen. The same projection as world_to_clip(), whose floats lose millimetres far from the origin.
#pragma once

#include <glm/vec3.hpp>

#include "terrain/view.h"

namespace terrabench {

struct ScreenPoint {
  double x = 0, y = 0;  // pixels from the top left corner
  double depth = 0;     // metres along the line of sight; x and y mean something only where it is positive
};

class Projector {
 public:
  explicit Projector(const View&);  // a view that check_view() lets pass

  ScreenPoint operator()(const glm::dvec3&) const;
  bool in_view(const ScreenPoint&) const;
  // Pixels between the pictures of two points, of the part of the segment before the near plane.
  double pixels_between(const glm::dvec3&, const glm::dvec3&) const;
  // Whether any of the segment is in view, by more than rounding.
  bool sees_segment(const glm::dvec3&, const glm::dvec3&) const;
  double focal() const { return focal_; }  // pixels that a metre across covers at a depth of a metre

 private:
  glm::dvec3 eye_, right_, above_, forward_;
  double focal_;
  double width_, height_, near_, far_;
};

}  // namespace terrabench
