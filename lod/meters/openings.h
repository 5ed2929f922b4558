// Detects openings in the drawn surface of ground with overhangs and caves, where heights by sample
// (cracks.h) do not apply: exactly, by its edges. See bare_pixels.h for what is seen through them.
#pragma once

#include <cstddef>

#include "terrain/frame.h"
#include "terrain/heightfield.h"
#include "terrain/view.h"

namespace terrabench {

// An edge is closed when as many triangles have it in one direction as in the other, with ends equal to the
// bit; surfaces that meet in one line may have it several times. Edges on the border of the ground's extent
// have no neighbour, nor have edges out of view beside culled triangles; neither counts.
struct OpenEdges {
  std::size_t edges = 0;  // in view
  // Of the ends of these edges, the largest distance to the nearest open edge in the opposite direction: the
  // width of the widest gap. For T-junctions without a gap that a float can hold, 0 with edges > 0.
  double largest_gap_m = 0;
  double largest_gap_px = 0;  // on the screen, pixels
  std::size_t unmatched = 0;  // edges without any open edge in the opposite direction
};

// For a frame over ground of this extent; its heights are not read. O(triangles log triangles + open edges
// squared).
OpenEdges find_open_edges(const Frame&, const Heightfield& ground, const View&);

}  // namespace terrabench
