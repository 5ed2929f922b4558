#include "terrain/frustum.h"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace terrabench {

Frustum::Frustum(const View& view) {
  const glm::mat4 rows = glm::transpose(world_to_clip(view));
  for (int axis = 0; axis < 3; ++axis) {
    planes_[2 * axis] = rows[3] + rows[axis];
    planes_[2 * axis + 1] = rows[3] - rows[axis];
  }
}

Sight Frustum::see(const Bounds& box) const {
  const glm::vec3 centre = 0.5F * (box.low + box.high);
  const glm::vec3 half = 0.5F * box.size();
  Sight sight = Sight::kInside;
  for (const glm::vec4& plane : planes_) {
    const glm::vec3 normal(plane);
    const float distance = glm::dot(normal, centre) + plane.w;
    const float reach = glm::dot(glm::abs(normal), half);
    if (distance < -reach) return Sight::kOutside;
    if (distance < reach) sight = Sight::kCrossing;
  }
  return sight;
}

}  // namespace terrabench
