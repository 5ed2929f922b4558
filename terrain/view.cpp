#include "terrain/view.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/vec2.hpp>
#include <limits>

namespace terrabench {

glm::mat4 world_to_clip(const View& view) {
  const float aspect = static_cast<float>(view.width) / static_cast<float>(view.height);
  return glm::perspective(view.vertical_fov, aspect, view.near, view.far) *
         glm::lookAt(view.eye, view.target, view.up);
}

View overview(const Bounds& bounds, int width, int height, glm::vec3 from) {
  constexpr float kMargin = 1.04F;  // around the outline, as a share of the picture
  constexpr int kSteps = 12;        // fixed-point iterations; each leaves a small share of the error
  View view;
  view.width = width;
  view.height = height;
  view.vertical_fov = 0.5F;
  view.target = 0.5F * (bounds.low + bounds.high);
  from = glm::normalize(from);
  const glm::vec3 right = glm::normalize(glm::cross(view.up, from));
  const glm::vec3 above = glm::cross(from, right);
  const float slope_y = std::tan(0.5F * view.vertical_fov);
  const float slope_x = slope_y * static_cast<float>(width) / static_cast<float>(height);
  const float radius = std::max(0.5F * glm::length(bounds.size()), 1e-3F);
  float distance = 2 * radius / std::min(slope_x, slope_y);
  for (int step = 0; step < kSteps; ++step) {
    glm::vec2 low(std::numeric_limits<float>::infinity()), high(-low);
    for (int corner = 0; corner < 8; ++corner) {
      const glm::vec3 offset = glm::vec3((corner & 1) != 0 ? bounds.high.x : bounds.low.x,
                                         (corner & 2) != 0 ? bounds.high.y : bounds.low.y,
                                         (corner & 4) != 0 ? bounds.high.z : bounds.low.z) -
                               view.target;
      const float depth = distance - glm::dot(offset, from);
      const glm::vec2 at =
          glm::vec2(glm::dot(offset, right) / slope_x, glm::dot(offset, above) / slope_y) / depth;
      low = glm::min(low, at);
      high = glm::max(high, at);
    }
    const glm::vec2 middle = 0.5F * (low + high), half = 0.5F * (high - low);
    view.target += distance * (middle.x * slope_x * right + middle.y * slope_y * above);
    distance = std::max(distance * std::max(half.x, half.y) * kMargin, radius * 1.05F);
  }
  view.eye = view.target + from * distance;
  const float reach = glm::length(view.target - 0.5F * (bounds.low + bounds.high)) + radius * 1.01F;
  view.near = std::max(distance - reach, distance * 0.01F);
  view.far = distance + reach;
  return view;
}

}  // namespace terrabench
