#include "representations/procedural_mesh/boundary_search.h"

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <limits>

namespace terrabench {
namespace {

bool finite(glm::vec3 p) { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z); }

// A balanced k-d tree as a permutation: the middle of each range splits it by the axis of its depth.
class PointTree {
 public:
  PointTree(std::span<const glm::vec3> positions, std::vector<std::uint32_t> points)
      : positions_(positions), points_(std::move(points)) {
    build(0, points_.size(), 0);
  }

  // The points within `distance` of the segment.
  void near(glm::dvec3 a, glm::dvec3 b, double distance, std::vector<std::uint32_t>& out) const {
    visit(0, points_.size(), 0, {a, b - a, distance, &out}, 0, 1);
  }

 private:
  struct Query {
    glm::dvec3 origin, along;
    double distance;
    std::vector<std::uint32_t>* out;
  };

  void build(std::size_t first, std::size_t last, int axis) {
    if (last - first < 2) return;
    const std::size_t middle = first + (last - first) / 2;
    const auto at = [&](std::size_t i) { return points_.begin() + static_cast<std::ptrdiff_t>(i); };
    std::nth_element(at(first), at(middle), at(last), [&](std::uint32_t a, std::uint32_t b) {
      const float x = positions_[a][axis], y = positions_[b][axis];
      return x != y ? x < y : a < b;
    });
    build(first, middle, (axis + 1) % 3);
    build(middle + 1, last, (axis + 1) % 3);
  }

  // Looks at the part of the segment between the parameters t0 and t1.
  void visit(std::size_t first, std::size_t last, int axis, const Query& q, double t0, double t1) const {
    if (first == last || t0 > t1) return;
    const std::size_t middle = first + (last - first) / 2;
    const glm::dvec3 p(positions_[points_[middle]]);
    const double square = glm::dot(q.along, q.along);
    const double t = square > 0 ? std::clamp(glm::dot(p - q.origin, q.along) / square, 0.0, 1.0) : 0;
    if (glm::distance(p, q.origin + q.along * t) <= q.distance) q.out->push_back(points_[middle]);
    const double slope = q.along[axis], from = q.origin[axis];
    // The parameters at which the segment is below split + distance, and above split - distance.
    const double below = p[axis] + q.distance - from, above = p[axis] - q.distance - from;
    double left0 = t0, left1 = t1, right0 = t0, right1 = t1;
    if (slope > 0) {
      left1 = std::min(t1, below / slope);
      right0 = std::max(t0, above / slope);
    } else if (slope < 0) {
      left0 = std::max(t0, below / slope);
      right1 = std::min(t1, above / slope);
    } else {
      if (below < 0) left1 = t0 - 1;
      if (above > 0) right1 = t0 - 1;
    }
    visit(first, middle, (axis + 1) % 3, q, left0, left1);
    visit(middle + 1, last, (axis + 1) % 3, q, right0, right1);
  }

  std::span<const glm::vec3> positions_;
  std::vector<std::uint32_t> points_;
};

}  // namespace

std::vector<VertexInEdge> vertices_in_edges(std::span<const glm::vec3> positions,
                                            std::span<const VertexPair> edges, float tolerance) {
  std::vector<std::uint32_t> ends;
  for (const auto& [a, b] : edges) {
    if (finite(positions[a])) ends.push_back(a);
    if (finite(positions[b])) ends.push_back(b);
  }
  std::sort(ends.begin(), ends.end());
  ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
  const PointTree tree(positions, std::move(ends));
  std::vector<VertexInEdge> found;
  std::vector<std::uint32_t> near;
  for (const auto& edge : edges) {
    if (!finite(positions[edge.first]) || !finite(positions[edge.second])) continue;
    const glm::dvec3 a(positions[edge.first]), b(positions[edge.second]);
    // Half a unit in the last place along each axis, for the result and for a sum or a product before it.
    const glm::dvec3 largest = glm::max(glm::abs(a), glm::abs(b));
    const double rounding = glm::length(largest) * static_cast<double>(std::numeric_limits<float>::epsilon());
    const double distance = std::max(static_cast<double>(tolerance) * glm::distance(a, b), rounding);
    near.clear();
    tree.near(a, b, distance, near);
    std::sort(near.begin(), near.end());
    for (const std::uint32_t v : near) {
      const glm::dvec3 p(positions[v]);
      if (glm::distance(p, a) > distance && glm::distance(p, b) > distance) found.push_back({v, edge});
    }
  }
  return found;
}

}  // namespace terrabench
