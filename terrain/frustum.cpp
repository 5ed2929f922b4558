#include "terrain/frustum.h"

#include <bit>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace terrabench {

Frustum::Frustum(const View& view) {
  const glm::dvec3 eye(view.eye);
  const glm::dvec3 forward = glm::normalize(glm::dvec3(view.target) - eye);
  const glm::dvec3 right = glm::normalize(glm::cross(forward, glm::dvec3(view.up)));
  const glm::dvec3 above = glm::cross(right, forward);
  const double slope_y = std::tan(0.5 * static_cast<double>(view.vertical_fov));
  const double slope_x = slope_y * view.width / view.height;
  const auto plane = [&](const glm::dvec3& normal, double at_eye) {
    return Plane{normal, at_eye - glm::dot(normal, eye)};
  };
  planes_ = {plane(slope_x * forward + right, 0), plane(slope_x * forward - right, 0),
             plane(slope_y * forward + above, 0), plane(slope_y * forward - above, 0),
             plane(forward, -view.near),          plane(-forward, view.far)};
}

std::array<glm::dvec4, 6> Frustum::planes() const {
  std::array<glm::dvec4, 6> planes;
  for (std::size_t k = 0; k < planes.size(); ++k) planes[k] = {planes_[k].normal, planes_[k].offset};
  return planes;
}

Sight Frustum::see(const Bounds& box) const {
  unsigned planes = kAllPlanes;
  return see(box, planes);
}

Sight Frustum::see(const Bounds& box, unsigned& planes) const {
  const glm::dvec3 centre = 0.5 * (glm::dvec3(box.low) + glm::dvec3(box.high));
  const glm::dvec3 half = glm::dvec3(box.high) - centre;
  for (unsigned left = planes; left != 0; left &= left - 1) {
    const Plane& plane = planes_[static_cast<std::size_t>(std::countr_zero(left))];
    const double distance = glm::dot(plane.normal, centre) + plane.offset;
    const double reach = glm::dot(glm::abs(plane.normal), half);
    if (distance < -reach) return Sight::kOutside;
    if (!(distance < reach)) planes &= ~(left & -left);
  }
  return planes == 0 ? Sight::kInside : Sight::kCrossing;
}

}  // namespace terrabench
