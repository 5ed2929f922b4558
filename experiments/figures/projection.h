// Where a point of space appears in a picture, and on a sheet for lines and words over the picture.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

#include "experiments/figures/sheet.h"
#include "terrain/view.h"

namespace terrabench::figures {

// In pixels from the picture's upper left corner, of a point in front of the eye; may lie outside the
// picture.
inline glm::dvec2 pixel_of(const View& view, const glm::vec3& point) {
  const glm::vec4 clip = world_to_clip(view) * glm::vec4(point, 1);
  return {(0.5 + 0.5 * clip.x / clip.w) * view.width, (0.5 - 0.5 * clip.y / clip.w) * view.height};
}

struct Projected {
  SheetPoint at;  // from the picture's upper left corner, in units of the sheet; may lie outside the picture
  double depth;   // metres in front of the eye; `at` means nothing where it is 0 or less
};

inline Projected project(const View& view, const glm::vec3& point) {
  const glm::vec4 clip = world_to_clip(view) * glm::vec4(point, 1);
  const double x = clip.x / clip.w, y = clip.y / clip.w;
  return {{(0.5 + 0.5 * x) * view.width / Sheet::kPixels, (0.5 - 0.5 * y) * view.height / Sheet::kPixels},
          clip.w};
}

}  // namespace terrabench::figures
