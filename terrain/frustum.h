// The part of space that a view sees, as six planes: what level-of-detail methods cull against.
#pragma once

#include <array>
#include <glm/vec3.hpp>

#include "terrain/solid.h"
#include "terrain/view.h"

namespace terrabench {

enum class Sight { kOutside, kCrossing, kInside };

class Frustum {
 public:
  explicit Frustum(const View&);

  // kOutside is certain; kCrossing may be said of a box just outside an edge or a corner (conservative).
  Sight see(const Bounds& box) const;
  // For boxes inside each other: tests the planes in `planes` alone, a bit each, and takes those out that the
  // box lies wholly inside of.
  static constexpr unsigned kAllPlanes = 0x3F;
  Sight see(const Bounds& box, unsigned& planes) const;

 private:
  // In double: floats lose centimetres where coordinates have six digits, and what is culled must not be in
  // view.
  struct Plane {
    glm::dvec3 normal;
    double offset;  // dot(normal, p) + offset ≥ 0 inside
  };
  std::array<Plane, 6> planes_;
};

}  // namespace terrabench
