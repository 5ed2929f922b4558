// A ray against triangles whose corners are shared, after Woop, Benthin & Wald ("Watertight Ray/Triangle
// Intersection", 2013): no ray passes between two triangles with a common edge, because both compute the
// same number for it, up to the sign. In double precision; both sides count.
#pragma once

#include <array>
#include <cmath>
#include <glm/vec3.hpp>
#include <limits>

#include "representations/ray_walk.h"

namespace terrabench {

class TriangleRay {
 public:
  explicit TriangleRay(const RayPath& path) : origin_(path.origin) {
    const glm::dvec3 d = path.direction, size{std::abs(d.x), std::abs(d.y), std::abs(d.z)};
    along_ = size.x > size.y ? (size.x > size.z ? 0 : 2) : (size.y > size.z ? 1 : 2);
    a_ = (along_ + 1) % 3;
    b_ = (along_ + 2) % 3;
    per_ = 1 / d[along_];
    shear_a_ = d[a_] * per_;
    shear_b_ = d[b_] * per_;
  }

  // Where the ray's whole line meets the triangle, in lengths of the direction; infinite for nowhere, and for
  // a triangle that the line lies in.
  double meets(const std::array<glm::vec3, 3>& corners) const {
    std::array<double, 3> a, b, c;  // with the ray along c
    for (std::size_t k = 0; k < 3; ++k) {
      const glm::dvec3 p = glm::dvec3(corners[k]) - origin_;
      a[k] = p[a_] - shear_a_ * p[along_];
      b[k] = p[b_] - shear_b_ * p[along_];
      c[k] = per_ * p[along_];
    }
    const double u = a[2] * b[1] - b[2] * a[1], v = a[0] * b[2] - b[0] * a[2], w = a[1] * b[0] - b[1] * a[0];
    if ((u < 0 || v < 0 || w < 0) && (u > 0 || v > 0 || w > 0)) return kNone;
    const double sum = u + v + w;
    return sum == 0 ? kNone : (u * c[0] + v * c[1] + w * c[2]) / sum;
  }

 private:
  static constexpr double kNone = std::numeric_limits<double>::infinity();

  glm::dvec3 origin_;
  int along_ = 0, a_ = 1, b_ = 2;  // the direction's largest component, and the others
  double per_, shear_a_, shear_b_;
};

}  // namespace terrabench
