// What linear erosion and the three faults share (Alonso, Joan-Arinyo & Solano, §3.2, figures 13 and 14): an
// event along a line, in its coordinates u (along) and d (left). Each new heightmap has an array of its own
// along the line, with cells no further apart than the root's samples. Its heights are read from the surface
// ("simple linear interpolation"); the inclined plane moves them.
#pragma once

#include <functional>

#include "representations/ght/cut_out.h"

namespace terrabench::ght {

// The number of steps of at most one sample spacing along a length.
int steps(double length, const SampleGrid& grid);
// The step, of `steps`, nearest to a share of the way.
int nearest_step(double share, int steps);

// Step 2. Appends a heightmap of `columns` × `rows` steps, one cell more along each axis. Its plane is given
// in coordinates (u, d, y) of the line: the first cell, the step per column, the step per row. From each row
// to the next, the step per column grows by `taper` along u.
struct PlaneAlong {
  glm::dvec3 origin, column, row;
  double taper = 0;
};
GroundedHeightmap append_along(Edit& edit, const events::Line& line, int columns, int rows,
                               const PlaneAlong& plane, Area area = Area::kOutdoor);

// Step 1 of an Edit, with a margin around the event so that the ring has a width.
RemovedPart cut_out_with_margin(Edit& edit, TurnedRectangle shape);

// Step 4. Closes the ring and supersedes every old cell inside it by `nearest`, which gives the new cell for
// a point of the old ground, as (u, d). `outline` lists boundary cells in order, counter-clockwise; links and
// repetitions are allowed.
void join_to_ground(Edit& edit, const events::Line& line, const RemovedPart& old, std::vector<CellId> outline,
                    const std::function<CellId(glm::dvec2)>& nearest);

}  // namespace terrabench::ght
