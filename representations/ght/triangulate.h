// Triangulation by cutting off ears (Meisters 1975), without new points: for the ring between a hole in the
// surface and the new heightmaps in it. The ear that leaves the shortest side is cut first, slivers last, so
// that the triangles of a thin ring stay short. A spatial hash keeps each test local: O(n log n) for rings of
// even spacing.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <glm/vec2.hpp>
#include <optional>
#include <span>
#include <vector>

namespace terrabench::ght {

using Triangle = std::array<std::uint32_t, 3>;  // counter-clockwise

// Triangulates a simple polygon, counter-clockwise, into indices of `points`. Nothing when it is not simple.
std::optional<std::vector<Triangle>> triangulate(std::span<const glm::dvec2> points);

// Whether two points are already joined elsewhere and so must not be joined again.
using Joined = std::function<bool(std::uint32_t, std::uint32_t)>;

// Triangulates the ring between two loops, both counter-clockwise, `inner` inside `outer`. Indices count the
// outer points, then the inner ones. Nothing when the loops meet or are not simple, or `joined` leaves no
// way.
std::optional<std::vector<Triangle>> triangulate_ring(
    std::span<const glm::dvec2> outer, std::span<const glm::dvec2> inner,
    const Joined& joined = [](std::uint32_t, std::uint32_t) { return false; });

// Twice the area of a triangle; positive when counter-clockwise.
inline double turn(glm::dvec2 a, glm::dvec2 b, glm::dvec2 c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

}  // namespace terrabench::ght
