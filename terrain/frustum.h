// The view frustum as six planes, for culling. O(1) per box.
#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "terrain/solid.h"
#include "terrain/view.h"

namespace terrabench {

enum class Sight { kOutside, kCrossing, kInside };

class Frustum {
 public:
  explicit Frustum(const View&);

  // Conservative: kOutside and kInside are certain; a box just outside an edge or a corner may get kCrossing.
  Sight see(const Bounds& box) const;
  // For nested boxes: tests only the planes whose bits are set in `planes`, and clears the bits of those that
  // the box lies wholly inside of.
  static constexpr unsigned kAllPlanes = 0x3F;
  Sight see(const Bounds& box, unsigned& planes) const;

  // Normals, and as w the offset: inside, dot(normal, p) + offset ≥ 0.
  std::array<glm::dvec4, 6> planes() const;

 private:
  // In double: with coordinates of six digits, floats lose centimetres, and could cull what is in view.
  struct Plane {
    glm::dvec3 normal;
    double offset;  // inside: dot(normal, p) + offset ≥ 0
  };
  std::array<Plane, 6> planes_;
};

}  // namespace terrabench
