// Cracks in the drawn surface: the neutral detector of T-junctions, gaps and overlaps.
//
// An edge is closed when another triangle runs the very same edge, plan and heights, the other way. All other
// edges are grouped by the line that they lie on in plan, and on each line the heights of its two sides are
// compared wherever an edge of either side ends; between those places both sides are straight, so no gap
// between them is larger. Edges along the terrain's border, and edges out of view beside what was culled,
// have nothing beside them, as they should. Triangles without plan area are left out: a gap behind a skirt is
// a gap. Overlaps are found by edges run twice and, where a layer lies over another so far that its rim is
// out of view, by the samples covered twice (coverage.h). O(triangles log triangles) time, in parallel;
// memory bounded, by several passes over large frames.
#pragma once

#include <cstddef>

#include "terrain/frame.h"
#include "terrain/view.h"

namespace terrabench {

struct CrackReport {
  std::size_t t_junctions = 0;       // vertices inside an edge of the triangle across, gap or not
  std::size_t open_t_junctions = 0;  // those off the edge by more than a float's rounding
  std::size_t gaps = 0;              // places, T-junction or not, where two sides differ so
  double largest_gap_m = 0;          // metres, vertically
  double largest_gap_px = 0;         // pixels, of gaps in view
  // Edges (or parts) in view with nothing drawn beside them that meets them: a missing triangle, or one drawn
  // over others. Where a method leaves out what it proved hidden, its rim counts here; what matters then is
  // ScreenDeviation::visible.undrawn.
  std::size_t bare_edges = 0;
  std::size_t overlaps = 0;  // edges run more than once the same way: triangles drawn over each other
  // Samples of the full terrain under more than one triangle, in view or not; not counted over endless
  // ground.
  std::size_t covered_again = 0;
  // Triangles that wind clockwise from above, where nobody sees them: holes. For the counts above they are
  // turned.
  std::size_t flipped = 0;

  std::size_t faults() const { return gaps + bare_edges + overlaps + covered_again + flipped; }
  bool tight() const { return faults() == 0; }
};

// Of a frame over terrain of width × depth samples, looked at from `view`.
CrackReport find_cracks(const Frame&, int width, int depth, const View& view);

}  // namespace terrabench
