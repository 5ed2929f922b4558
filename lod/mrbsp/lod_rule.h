// The depth at which level of detail draws (MRBSP paper, §3): the triangle is cut while all of its corners,
// at their distances D, ask for more.
//
// Printed: depth M - log2(D/S), S the short side of the smallest triangles. Bisection halves the area and not
// the side, so that the apparent side falls with 1/√D; M - 2·log2(D/S) keeps it the same. The paper's figure
// counts whole thresholds: ours are rounded up, so no triangle is larger than asked. O(1).
#pragma once

#include <bit>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace terrabench {

class LodRule {
 public:
  // `short_side`: S in metres, times what the knob makes of it. `area_consistent`: M - 2·log2(D/S).
  LodRule(int deepest, double short_side, bool area_consistent)
      : deepest_(deepest),
        area_consistent_(area_consistent),
        per_square_(static_cast<float>(1 / (short_side * short_side))) {}

  // What a vertex asks for: beyond the deepest level when it is near, below the square's when it is far.
  int threshold(const glm::vec3& eye, const glm::vec3& vertex) const {
    const glm::vec3 to = vertex - eye;
    const int steps = floor_log2(glm::dot(to, to) * per_square_);
    return deepest_ - (area_consistent_ ? steps : steps >> 1);
  }

 private:
  // ⌊log2(x)⌋ for x ≥ 0, infinity included; far below for what is smaller than any normal number.
  static int floor_log2(float x) { return static_cast<int>(std::bit_cast<std::uint32_t>(x) >> 23) - 127; }

  int deepest_;
  bool area_consistent_;
  float per_square_;  // 1/S²
};

}  // namespace terrabench
