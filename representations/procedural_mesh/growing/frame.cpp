#include "representations/procedural_mesh/growing/frame.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace terrabench::growing {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

// Mean distance of opposite corners: for odd counts, of each corner to the two farthest in order.
double mean_diagonal(std::span<const std::uint32_t> corners, std::span<const glm::vec3> positions) {
  const std::size_t n = corners.size();
  double sum = 0;
  for (std::size_t i = 0; i < n; ++i) {
    sum += glm::distance(glm::dvec3(positions[corners[i]]), glm::dvec3(positions[corners[(i + n / 2) % n]]));
  }
  return sum / static_cast<double>(n);
}

void rotate_pair(glm::dvec3& a, glm::dvec3& b, double degrees) {
  const double c = std::cos(degrees * kDegree), s = std::sin(degrees * kDegree);
  const glm::dvec3 turned = a * c + b * s;
  b = b * c - a * s;
  a = turned;
}

}  // namespace

FaceShape face_shape(std::span<const std::uint32_t> corners, std::span<const glm::vec3> positions) {
  FaceShape shape;
  const std::size_t n = corners.size();
  glm::dvec3 centre(0);
  for (const std::uint32_t corner : corners) centre += glm::dvec3(positions[corner]);
  centre /= static_cast<double>(n);
  glm::dvec3 normal(0);  // twice the area long
  for (std::size_t i = 0; i < n; ++i) {
    normal += glm::cross(glm::dvec3(positions[corners[i]]) - centre,
                         glm::dvec3(positions[corners[(i + 1) % n]]) - centre);
  }
  shape.frame.origin = centre;
  shape.size = mean_diagonal(corners, positions);
  const double length = glm::length(normal);
  if (!(length > 0) || !std::isfinite(length)) return shape;
  const glm::dvec3 z = normal / length;
  const glm::dvec3 edge = glm::dvec3(positions[corners[1]]) - glm::dvec3(positions[corners[0]]);
  glm::dvec3 x = edge - z * glm::dot(edge, z);
  if (glm::length(x) < 1e-9 * glm::length(edge) || !(glm::length(edge) > 0)) {
    x = glm::cross(z, std::abs(z.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0));
  }
  shape.area = length / 2;
  shape.frame.x = glm::normalize(x);
  shape.frame.z = z;
  shape.frame.y = glm::cross(z, shape.frame.x);
  return shape;
}

void turn(Frame& frame, const glm::dvec3& degrees) {
  if (degrees.y != 0) rotate_pair(frame.z, frame.x, degrees.y);
  if (degrees.x != 0) rotate_pair(frame.y, frame.z, degrees.x);
  if (degrees.z != 0) rotate_pair(frame.x, frame.y, degrees.z);
}

void turn_towards(Frame& frame, const glm::dvec3& up, double degrees) {
  const glm::dvec3 target = degrees < 0 ? -up : up;
  const glm::dvec3 axis = glm::cross(frame.z, target);
  const double sine = glm::length(axis);
  if (degrees == 0 || sine < 1e-9) return;
  const double most = std::atan2(sine, glm::dot(frame.z, target));
  const double angle = std::min(std::abs(degrees) * kDegree, most);
  const glm::dvec3 unit = axis / sine;
  for (glm::dvec3* const v : {&frame.x, &frame.y, &frame.z}) {
    *v = *v * std::cos(angle) + glm::cross(unit, *v) * std::sin(angle) +
         unit * (glm::dot(unit, *v) * (1 - std::cos(angle)));
  }
}

}  // namespace terrabench::growing
