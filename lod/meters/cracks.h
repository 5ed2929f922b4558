// Detects T-junctions, gaps and overlaps in the drawn surface of any method over a heightfield. For ground
// with overhangs and caves see openings.h.
//
// An edge is closed when another triangle has the same edge, in plan and heights, in the opposite direction.
// The other edges are grouped by their line in plan. On each line, the heights of its two sides are compared
// wherever an edge of either side ends; in between both sides are straight, so no gap is larger. Edges on the
// terrain's border have no neighbour, nor have edges out of view beside culled triangles; neither is a fault.
// Triangles without plan area are ignored: a gap behind a skirt is a gap. Overlaps are found as edges that
// occur twice in one direction and, where a layer is so large that its rim is out of view, as samples covered
// twice. O(triangles log triangles) time, in parallel; bounded memory, by several passes over
// large frames.
#pragma once

#include <cstddef>

#include "terrain/frame.h"
#include "terrain/view.h"

namespace terrabench {

struct CrackReport {
  std::size_t t_junctions = 0;  // vertices inside an edge of the neighbouring triangle, with a gap or not
  std::size_t open_t_junctions = 0;  // those off the edge by more than a float's rounding
  std::size_t gaps = 0;              // places where two sides differ by more than that, T-junction or not
  double largest_gap_m = 0;          // vertically, metres
  double largest_gap_px = 0;         // of gaps in view, pixels
  // Edges, or parts of edges, in view without a neighbour: a triangle is missing, or drawn over others. If a
  // method omits triangles that it proved hidden, their rim counts here; then
  // ScreenDeviation::visible.undrawn decides.
  std::size_t bare_edges = 0;
  std::size_t overlaps = 0;  // edges that occur again in the same direction: triangles drawn over each other
  // Samples of the full terrain under more than one triangle, in view or not; not counted over endless
  // ground.
  std::size_t covered_again = 0;
  // Triangles that are clockwise from above and therefore invisible: holes. For the other counts they are
  // turned.
  std::size_t flipped = 0;

  std::size_t faults() const { return gaps + bare_edges + overlaps + covered_again + flipped; }
  bool tight() const { return faults() == 0; }
};

// For a frame over terrain of width × depth samples, seen from `view`.
CrackReport find_cracks(const Frame&, int width, int depth, const View& view);

}  // namespace terrabench
