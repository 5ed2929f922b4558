// What must hold for a tree after any sequence of events, checked from scratch and without the code that
// applies events. O(cells + faces log faces).
#pragma once

#include <string>
#include <vector>

#include "representations/ght/model.h"

namespace terrabench::ght {

struct Census {
  std::size_t nodes = 0, heights = 0, links = 0, voids = 0, faces = 0, boundary_links = 0;
  std::uint32_t deepest = 0;  // number of nodes above the deepest one
};
Census census(const Model& model);

// The number of boundary cells, in the heightmaps that the last event added, that no face joins to a cell of
// another heightmap. The paper links them all (§3.2: "each cell in the boundary of a new heightmap is linked
// to the neighbor cell in another heightmap"). A link is not stored: it is an edge of a face between cells of
// two heightmaps (Census::boundary_links).
std::size_t unlinked_boundary_cells(const Model& model);

// One line per kind of violation: links that dangle or do not reach the surface, an event with a wrong number
// of heightmaps, nodes whose parent is not an earlier one, faces with corners without a height, plain squares
// with a corner elsewhere, edges without an opposite one, boundary cells without a link. Empty for a valid
// tree.
std::vector<std::string> broken_invariants(const Model& model);

}  // namespace terrabench::ght
