// The reference frame of a face (Tobler, Maierhofer and Wilkie, §4, figure 7).
#pragma once

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <span>

namespace terrabench::growing {

// From local coordinates to the world's: world = origin + x·local.x + y·local.y + z·local.z. Unit axes,
// perpendicular, right-handed.
struct Frame {
  glm::dvec3 origin{0}, x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};

  glm::dvec3 to_world(const glm::dvec3& p) const { return origin + x * p.x + y * p.y + z * p.z; }
  glm::dvec3 to_local(const glm::dvec3& world) const {
    const glm::dvec3 d = world - origin;
    return {glm::dot(d, x), glm::dot(d, y), glm::dot(d, z)};
  }
};

struct FaceShape {
  Frame frame;
  double size = 0, area = 0;  // as "size" and "area" in rules.h; area 0: the frame is not defined
};

// Of a polygon with 3 or more corners; `positions` are all vertices. O(corners).
FaceShape face_shape(std::span<const std::uint32_t> corners, std::span<const glm::vec3> positions);

// Turns the frame about its own axes, first y, then x, then z; degrees, counter-clockwise.
void turn(Frame&, const glm::dvec3& degrees);

// Turns z towards `up`, a unit vector, by at most |degrees|; with degrees < 0 towards -up. Does nothing where
// z has that direction or the opposite one.
void turn_towards(Frame&, const glm::dvec3& up, double degrees);

}  // namespace terrabench::growing
