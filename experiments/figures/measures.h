// What several papers measure on what their figures show: angles, faces and correlations.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <span>

namespace terrabench::figures {

// In radians, of two directions of any length.
inline double angle_between(const glm::dvec3& a, const glm::dvec3& b) {
  return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

// The product of a face's first diagonal and its second: along its normal, twice as long as its area. A
// triangle's second diagonal is its first edge. `Vec`: glm::vec3, or glm::dvec3 to compute in doubles.
template <class Vec>
Vec across_face(std::span<const glm::vec3> positions, std::span<const std::uint32_t> corners) {
  const auto at = [&](std::size_t k) { return Vec(positions[corners[k % corners.size()]]); };
  return glm::cross(at(2) - at(0), at(3) - at(1));
}

// Of a face of three or four corners, of unit length.
inline glm::dvec3 face_normal(std::span<const glm::vec3> positions, std::span<const std::uint32_t> corners) {
  return glm::normalize(across_face<glm::dvec3>(positions, corners));
}

// Pearson's correlation of pairs of numbers.
class Correlation {
 public:
  void add(double a, double b) { n_ += 1, a_ += a, b_ += b, ab_ += a * b, aa_ += a * a, bb_ += b * b; }
  // Whether both numbers differ between pairs; without that there is no correlation.
  bool exists() const { return spread() > 0; }
  double value() const { return (n_ * ab_ - a_ * b_) / std::sqrt(spread()); }

 private:
  double spread() const { return (n_ * aa_ - a_ * a_) * (n_ * bb_ - b_ * b_); }
  double n_ = 0, a_ = 0, b_ = 0, ab_ = 0, aa_ = 0, bb_ = 0;  // sums
};

}  // namespace terrabench::figures
