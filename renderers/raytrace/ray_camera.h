// A view's rays: a pinhole camera.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "renderers/raytrace/ray_index.h"
#include "terrain/view.h"

namespace terrabench {

class RayCamera {
 public:
  static constexpr int kLargestSide = 16384;  // pixels

  // Throws usage_error for sides outside 1…16384, a view that is not finite, a target at the eye, an up
  // along the line of sight, or a field of view outside (0, π). The view's depth range is ignored.
  explicit RayCamera(const View&);

  // Through a place in the picture in pixels from its upper left corner; of unit length.
  Ray ray(const glm::vec2& at) const;
  // The place times the depth along the line of sight, and that depth (homogeneous coordinates).
  glm::vec3 project(const glm::vec3& position) const;

 private:
  glm::vec3 eye_, forward_, right_, up_;
  glm::vec2 middle_;  // pixels
  float scale_;       // pixels per unit of slope
};

}  // namespace terrabench
