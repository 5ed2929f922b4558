// Heights by the recursion as printed (MRBSP paper, §2): each half of a triangle gets the points on its side
// of the divider, and each of its corners takes its height from the three nearest of these (nearest_three.h).
// Triangles that meet at a vertex then disagree on its height; with interpolate_heights() they agree.
// O(points × levels).
#pragma once

#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "lod/mrbsp/bisection_tree.h"

namespace terrabench {

// The paper does not say what happens to a point on the divider or to a triangle with few points. Here a
// point on the divider belongs to the half with the left corner, or to both halves if `shared` is set. A
// triangle with one or two points uses these; a triangle without points lies in its parent's plane.
struct SubsetTriangles {
  std::vector<glm::vec3> corners;  // three per triangle of the greatest depth, counter-clockwise from above
  std::size_t starved = 0;         // triangles of the greatest depth with fewer than three points
};
SubsetTriangles interpolate_subsets(std::span<const glm::vec3> points, const BisectionTree&, bool shared);

// How far the heights of each vertex differ between its triangles.
struct VertexGaps {
  std::size_t vertices = 0, torn = 0;  // torn: with more than one height
  double mean = 0, largest = 0;        // metres from the lowest to the highest; mean over all vertices
};
VertexGaps vertex_gaps(const SubsetTriangles&);

}  // namespace terrabench
