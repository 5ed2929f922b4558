// The height at a position from scattered points (MRBSP paper, §2): interpolated between the three points
// that are nearest in plan.
//
// The paper does not say what happens if the position lies outside the triangle of the three points, or if
// they lie in one line, as they often do on a grid. Here the height is taken at the place of the triangle
// nearest to the position in plan. So three points in a line need no special case, and no height leaves the
// range of its three points. Equally near points are taken in the order given. At a point the height is
// exactly that of the point.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "lod/mrbsp/bisection_tree.h"
#include "terrain/heightfield.h"
#include "terrain/progress.h"

namespace terrabench {

// The three nearest points offered so far, nearest first; of equally near points the lower number first.
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

  // The height interpolated at a position in plan. At least one point must have been offered.
  float height(glm::vec2 at) const;
};

// Finds the three nearest points in about constant time per query: points lie in square buckets of about two.
class NearestThree {
 public:
  // Peak during construction: a copy of the point, its number, and its half of a bucket's begin and end.
  static constexpr std::size_t kBytesPerPoint = sizeof(glm::vec3) + 2 * sizeof(std::uint32_t);

  // Positions in metres, y up, finite. Throws usage_error for no points or more than 2^31.
  explicit NearestThree(std::span<const glm::vec3> points);

  // With two points, interpolates along their segment; with one, returns its height everywhere.
  float height(float x, float z) const;

 private:
  int bucket_x(float x) const;
  int bucket_z(float z) const;

  std::vector<glm::vec3> points_;     // sorted by bucket
  std::vector<std::uint32_t> order_;  // number of each point as given, for ties
  std::vector<std::uint32_t> first_;  // first point of each bucket, and the end
  glm::vec2 low_{0};
  float side_ = 1;
  int columns_ = 1, rows_ = 1;
};

// The bounding rectangle of points in plan. plan_extent() throws usage_error for no points or more than 2^31.
struct PlanExtent {
  glm::vec2 low, high;
};
PlanExtent plan_extent(std::span<const glm::vec3> points);

inline glm::vec2 in_plan(const glm::vec3& p) { return {p.x, p.z}; }
inline float plan_cross(glm::vec2 a, glm::vec2 b) { return a.x * b.y - a.y * b.x; }

// Heights of the tree's vertices from height points (MRBSP paper, §2). Each vertex takes its height from the
// three nearest of all points, so all triangles that meet at a vertex agree on its height.
// (side + 1)² heights over the rectangle that the points span. O(points + vertices), in parallel; the result
// does not depend on the number of threads. Throws usage_error for points in one line.
Heightfield interpolate_heights(std::span<const glm::vec3> points, const BisectionTree&, Progress&);
// The field's samples as height points.
std::vector<glm::vec3> height_points(const Heightfield&);

}  // namespace terrabench
