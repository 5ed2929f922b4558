// The tree's heights by the recursion as printed (MRBSP paper, §2): each half of a triangle is handed the
// points on its side of the cut, and its corners take the three nearest of those (nearest_three.h). A vertex
// then has as many heights as triangles meet there; height_points.h does not tear it. O(points × levels).
#pragma once

#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "lod/mrbsp/bisection_tree.h"

namespace terrabench {

// What the paper does not say: a point on the cut goes to the side of the left corner, or to both
// (`cuts_shared`); a triangle with fewer than three points uses those, and one with none its parent's plane.
struct SubsetTriangles {
  std::vector<glm::vec3> corners;  // three a triangle of the greatest depth, counter-clockwise from above
  std::size_t starved = 0;         // triangles that were handed fewer than three points
};
SubsetTriangles interpolate_subsets(std::span<const glm::vec3> points, const BisectionTree&,
                                    bool cuts_shared);

// How far apart the heights of one place lie in such triangles.
struct VertexGaps {
  std::size_t vertices = 0, torn = 0;  // torn: with more than one height
  double mean = 0, largest = 0;        // metres between the lowest and highest, mean over all vertices
};
VertexGaps vertex_gaps(const SubsetTriangles&);

}  // namespace terrabench
