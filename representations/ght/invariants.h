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

// The stored boundary links against those that follow from the triangles of the surface: each cell of a
// heightmap other than the root that a triangle joins to a cell of another heightmap links to the nearest
// such cell (boundary_links.h). `wrong` counts cells whose link is missing, superfluous or another one.
struct LinkReport {
  std::size_t stored = 0, derived = 0, wrong = 0;
};
LinkReport check_boundary_links(const Model& model);

// The number of boundary cells, in the heightmaps that the last event added, that store no link. The paper
// links them all (§3.2: "each cell in the boundary of a new heightmap is linked to the neighbor cell in
// another heightmap").
std::size_t unlinked_boundary_cells(const Model& model);

// Links that end in no cell of the surface, and corners of its triangles that hold no height. The paper's
// null links, over the mouth of a carving, end in a void cell of its border, and are none of them.
struct Breaks {
  std::size_t dangling = 0, voids_seen = 0;
};
Breaks count_breaks(const Model& model);

// One line per kind of violation: links that dangle or do not reach the surface, an event with a wrong number
// of heightmaps, nodes whose parent is not an earlier one, faces with corners without a height, plain squares
// with a corner elsewhere, edges without an opposite one, boundary cells without a link, wrong boundary
// links. Empty for a valid tree.
std::vector<std::string> broken_invariants(const Model& model);

}  // namespace terrabench::ght
