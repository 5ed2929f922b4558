#include "terrain/view.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

namespace terrabench {

glm::mat4 world_to_clip(const View& view) {
  const float aspect = static_cast<float>(view.width) / static_cast<float>(view.height);
  return glm::perspective(view.vertical_fov, aspect, view.near, view.far) *
         glm::lookAt(view.eye, view.target, view.up);
}

View overview(const Bounds& bounds, int width, int height) {
  View view;
  view.width = width;
  view.height = height;
  view.vertical_fov = 0.5F;
  view.target = 0.5F * (bounds.low + bounds.high);
  const glm::vec3 from = glm::normalize(glm::vec3(0.55F, 0.75F, 1.0F));
  const glm::vec3 right = glm::normalize(glm::cross(view.up, from));
  const glm::vec3 above = glm::cross(from, right);
  const float slope_y = std::tan(0.5F * view.vertical_fov);
  const float slope_x = slope_y * static_cast<float>(width) / static_cast<float>(height);
  // Far enough that each corner of the box falls inside the picture, with a small margin.
  float distance = 0, radius = 0;
  for (int corner = 0; corner < 8; ++corner) {
    const glm::vec3 offset = glm::vec3((corner & 1) != 0 ? bounds.high.x : bounds.low.x,
                                       (corner & 2) != 0 ? bounds.high.y : bounds.low.y,
                                       (corner & 4) != 0 ? bounds.high.z : bounds.low.z) -
                             view.target;
    const float x = std::abs(glm::dot(offset, right)), y = std::abs(glm::dot(offset, above));
    distance = std::max(distance, glm::dot(offset, from) + std::max(x / slope_x, y / slope_y));
    radius = std::max(radius, glm::length(offset));
  }
  distance = std::max(distance * 1.04F, 1e-3F);
  view.eye = view.target + from * distance;
  view.near = std::max(distance - radius * 1.01F, distance * 0.01F);
  view.far = distance + radius * 1.01F + 1e-3F;
  return view;
}

}  // namespace terrabench
