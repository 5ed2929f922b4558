// What must be true of a tree after any sequence of events, checked from scratch and independently of how
// events do their work. O(cells + faces log faces).
#pragma once

#include <string>
#include <vector>

#include "representations/ght/surgery.h"

namespace terrabench::ght {

struct Census {
  std::size_t nodes = 0, heights = 0, links = 0, voids = 0, faces = 0, boundary_links = 0;
  std::uint32_t deepest = 0;  // nodes above the deepest one
};
Census census(const Model& model);

// Cells of the surface at the rim of a heightmap that the last event added (nothing of it beyond them) that
// no face joins to a cell of another one: the paper links each ("each cell in the boundary of a new heightmap
// is linked to the neighbor cell in another heightmap"). The links themselves are not stored but derived from
// the faces (boundary_links), so they run both ways.
std::size_t unlinked_boundary_cells(const Model& model);

// One line for each kind of thing that is wrong: links that dangle or do not reach the surface, heightmaps
// that are not as many as the event adds, nodes whose parent is not an earlier one, faces with corners that
// hold no height, plain squares whose corners stand elsewhere, edges without their counterpart, boundary
// cells without a link. Empty when all is well.
std::vector<std::string> broken_invariants(const Model& model);

}  // namespace terrabench::ght
