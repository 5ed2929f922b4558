// The part of space that a view sees, as six planes: what level-of-detail methods cull against.
#pragma once

#include <array>
#include <glm/vec4.hpp>

#include "terrain/solid.h"
#include "terrain/view.h"

namespace terrabench {

enum class Sight { kOutside, kCrossing, kInside };

class Frustum {
 public:
  explicit Frustum(const View&);

  // kOutside is certain; kCrossing may be said of a box just outside an edge or a corner (conservative).
  Sight see(const Bounds& box) const;

 private:
  std::array<glm::vec4, 6> planes_;  // dot(plane, (p, 1)) ≥ 0 inside
};

}  // namespace terrabench
