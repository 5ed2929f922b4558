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

// One line for each kind of thing that is wrong: links that dangle or do not reach the surface, heightmaps
// that are not as many as the event adds, nodes whose parent is not an earlier one, faces with corners that
// hold no height, squares whose corners do, edges without their counterpart, boundary links that run one way.
// Empty when all is well.
std::vector<std::string> broken_invariants(const Model& model);

}  // namespace terrabench::ght
