// Vertex heights from scattered height points (MRBSP paper, §2): "the three closest height points to the
// corner's x, y coordinate and then by interpolation".
//
// The paper leaves open what happens when the corner lies outside the three, or the three in one line, as
// they often do on a grid. Here the height is that of the triangle's point nearest to the corner in plan, so
// three in a line need no case of their own, and no height leaves the range of its three points. Equally near
// points are taken in the order given. A corner on a point has that point's height exactly.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "lod/mrbsp/bisection_tree.h"
#include "terrain/frame.h"
#include "terrain/heightfield.h"
#include "terrain/progress.h"

namespace terrabench {

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

// The lattice of (side + 1)² heights over the points, each from its own three nearest of all of them, so that
// a vertex has one height however many triangles meet there. The field covers the rectangle that the points
// span. O(points + vertices), in parallel; the same for any number of threads.
Heightfield interpolate_lattice(std::span<const glm::vec3> points, const BisectionTree&, Progress&);
// The grid's samples as height points.
std::vector<glm::vec3> height_points(const Heightfield&);

// The recursion as printed: each half of a triangle is handed the points on its side of the cut, and its
// corners take the three nearest of those. A vertex then has as many heights as triangles meet there.
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
