// The depth at which a triangle is drawn (MRBSP paper, §3): it is split while the thresholds of all its
// corners, at their distances D, exceed its depth.
//
// Printed threshold: M - log2(D/S), where S is the short side of the smallest triangles. A split halves the
// area, not the side, so with this formula the apparent side falls with 1/√D; M - 2·log2(D/S) keeps it
// constant. The paper's figure 1 shows integer thresholds. Here they are rounded up, so no triangle is larger
// than the formula says. O(1).
#pragma once

#include <bit>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace terrabench {

class LodRule {
 public:
  // `short_side`: S in metres, scaled by the knob. `area_consistent`: M - 2·log2(D/S).
  LodRule(int deepest, double short_side, bool area_consistent)
      : deepest_(deepest),
        area_consistent_(area_consistent),
        per_square_(static_cast<float>(1 / (short_side * short_side))) {}

  // Not clamped: greater than M near the eye, possibly negative far away.
  int threshold(const glm::vec3& eye, const glm::vec3& vertex) const {
    const glm::vec3 to = vertex - eye;
    const int steps = floor_log2(glm::dot(to, to) * per_square_);
    return deepest_ - (area_consistent_ ? steps : steps >> 1);
  }

 private:
  // ⌊log2(x)⌋ for normal x and infinity (128); -127 for 0 and subnormal x.
  static int floor_log2(float x) { return static_cast<int>(std::bit_cast<std::uint32_t>(x) >> 23) - 127; }

  int deepest_;
  bool area_consistent_;
  float per_square_;  // 1/S²
};

}  // namespace terrabench
