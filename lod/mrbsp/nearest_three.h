// Heights from scattered points (MRBSP paper, §2): of the three that lie nearest to a corner in plan,
// interpolated.
//
// The paper leaves open what happens when the corner lies outside the three, or the three in one line, as
// they often do on a grid. Here the height is that of the triangle's point nearest to the corner in plan, so
// three in a line need no case of their own, and no height leaves the range of its three points. Equally near
// points are taken in the order given. A corner on a point has that point's height exactly.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace terrabench {

// The three nearest so far, nearest first: of equally near points the first given wins.
struct ThreePoints {
  std::array<float, 3> distance{};  // squared
  std::array<std::uint32_t, 3> order{};
  std::array<glm::vec3, 3> point{};
  int count = 0;

  void offer(float d, std::uint32_t which, const glm::vec3& p) {
    if (count == 3 && !before(d, which, 2)) return;
    int at = count < 3 ? count++ : 2;
    for (; at > 0 && before(d, which, at - 1); --at) {
      distance[at] = distance[at - 1];
      order[at] = order[at - 1];
      point[at] = point[at - 1];
    }
    distance[at] = d;
    order[at] = which;
    point[at] = p;
  }
  bool before(float d, std::uint32_t which, int at) const {
    return d < distance[at] || (d == distance[at] && which < order[at]);
  }

  // The points interpolated at a place in plan; there must be one at least.
  float height(glm::vec2 at) const;
};

// Three points a query in about constant time: points sorted into square buckets of about two.
class NearestThree {
 public:
  // What it holds while it is made: a copy of the point, its number, and half a bucket's two ends.
  static constexpr std::size_t kBytesAPoint = sizeof(glm::vec3) + 2 * sizeof(std::uint32_t);

  // Positions in metres, y up; all finite. Throws usage_error for none, or more than 2^31.
  explicit NearestThree(std::span<const glm::vec3> points);

  // Fewer than three points give what they can: a segment, or one height for all.
  float height(float x, float z) const;

 private:
  int bucket_x(float x) const;
  int bucket_z(float z) const;

  std::vector<glm::vec3> points_;     // in the order of the buckets
  std::vector<std::uint32_t> order_;  // which point it was: ties go to the first
  std::vector<std::uint32_t> first_;  // of each bucket, and the end
  glm::vec2 low_{0};
  float side_ = 1;
  int columns_ = 1, rows_ = 1;
};

// The rectangle in plan that points span. Throws usage_error for none, or more than 2^31.
struct PlanExtent {
  glm::vec2 low, high;
};
PlanExtent plan_extent(std::span<const glm::vec3> points);

inline glm::vec2 in_plan(const glm::vec3& p) { return {p.x, p.z}; }
inline float plan_cross(glm::vec2 a, glm::vec2 b) { return a.x * b.y - a.y * b.x; }

}  // namespace terrabench
