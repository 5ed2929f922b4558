// Closed loops: the rims of a part of the surface, and the polygons that they form in plan.
#pragma once

#include <span>
#include <vector>

#include "representations/ght/composed_surface.h"

namespace terrabench::ght {

using Loop = std::vector<CellId>;

struct Edge {
  CellId from, to;
  auto operator<=>(const Edge&) const = default;
};

// Appends the three directed edges of a face.
inline void add_edges(const Face& face, std::vector<Edge>& edges) {
  for (std::size_t k = 0; k < 3; ++k) edges.push_back({face[k], face[(k + 1) % 3]});
}

// The loops that the edges without an opposite edge form, in their direction. There are none when loops meet
// in a cell, which is then appended to `pinched`, or when the edges do not close. O(n log n) for n edges.
std::vector<Loop> rims(std::vector<Edge> edges, std::vector<CellId>& pinched);

// The cells' positions in plan seen from above (map_point()).
std::vector<glm::dvec2> map_points(const Tree& tree, std::span<const CellId> cells);

// Of simple polygons, O(corners). Twice the area is positive when counter-clockwise.
double doubled_area(std::span<const glm::dvec2> polygon);
bool inside(std::span<const glm::dvec2> polygon, glm::dvec2 p);
// Whether p is inside and at least `margin` away from every side.
bool well_inside(std::span<const glm::dvec2> polygon, glm::dvec2 p, double margin);
// Whether the segments ab and cd cross, or pass each other at less than `margin`.
bool segments_within(glm::dvec2 a, glm::dvec2 b, glm::dvec2 c, glm::dvec2 d, double margin);

}  // namespace terrabench::ght
