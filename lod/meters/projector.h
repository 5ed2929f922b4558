// Projects points to a view's screen, in pixels: the one projection that all meters use. The same as
// world_to_clip(), but in double, because floats lose millimetres far from the origin.
#pragma once

#include <glm/vec3.hpp>

#include "terrain/view.h"

namespace terrabench {

struct ScreenPoint {
  double x = 0, y = 0;  // pixels from the top left corner
  double depth = 0;     // metres along the line of sight; x and y are valid only where it is positive
};

class Projector {
 public:
  explicit Projector(const View&);  // the view must pass check_view()

  ScreenPoint operator()(const glm::dvec3&) const;
  bool in_view(const ScreenPoint&) const;
  // Distance in pixels between two projected points; a segment that crosses the near plane is clipped at it.
  double pixels_between(const glm::dvec3&, const glm::dvec3&) const;
  // Whether any part of the segment is in view, by more than rounding.
  bool sees_segment(const glm::dvec3&, const glm::dvec3&) const;
  // Through a point of the screen, pixels; per metre of depth.
  glm::dvec3 direction(double x, double y) const {
    return forward_ + ((x - 0.5 * width_) * right_ + (0.5 * height_ - y) * above_) / focal_;
  }
  double focal() const { return focal_; }  // pixels per metre at a depth of 1 m

 private:
  glm::dvec3 eye_, right_, above_, forward_;
  double focal_;
  double width_, height_, near_, far_;
};

}  // namespace terrabench
