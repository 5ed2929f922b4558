#include "terrain/view.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/vec2.hpp>
#include <limits>
#include <numbers>

#include "terrain/error.h"

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
      const glm::vec3 offset = bounds.corner(corner) - view.target;
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

void check_view(const View& view) {
  if (!is_finite(view.eye))
    throw usage_error("eye must be finite", "eye", "give three finite coordinates in metres");
  if (!is_finite(view.target) || view.target == view.eye) {
    throw usage_error("target must be finite and differ from eye", "target", "choose another point");
  }
  const glm::dvec3 sight = glm::normalize(glm::dvec3(view.target) - glm::dvec3(view.eye));
  if (!is_finite(view.up) || !(glm::length(glm::cross(sight, glm::normalize(glm::dvec3(view.up)))) > 1e-6)) {
    throw usage_error("up must be finite and not parallel to the line of sight", "up",
                      "choose another direction");
  }
  if (!(view.vertical_fov > 0 && view.vertical_fov < std::numbers::pi_v<float>)) {
    throw usage_error(fmt::format("vertical_fov must be in (0, π), got {}", view.vertical_fov),
                      "vertical_fov", "give it in radians");
  }
  if (view.width < 1 || view.height < 1) {
    throw usage_error(
        fmt::format("width and height must be at least 1, got {} × {}", view.width, view.height),
        "width, height", "give them in pixels");
  }
  if (!(view.near > 0 && view.far > view.near && std::isfinite(view.far))) {
    throw usage_error(fmt::format("near and far must satisfy 0 < near < far < infinity, got {} and {}",
                                  view.near, view.far),
                      "near, far", "give both in metres");
  }
}

}  // namespace terrabench
