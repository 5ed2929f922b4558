// What is visible over the ground of mrbsp_ground.h, as the tests of visibility find it.
#pragma once

#include "lod/lod.h"
#include "lod/mrbsp/visibility_table.h"
#include "tests/lod/mrbsp_ground.h"

namespace terrabench {

inline VisibilityOptions few_cells(int cells = 8, int coarseness = 4, bool conservative = true) {
  VisibilityOptions options;
  options.conservative = conservative;
  options.cells = cells;
  options.coarseness = coarseness;
  return options;
}

inline VisibleSets visible_over(const Heightfield& field, const BisectionTree& tree,
                                const VisibilityOptions& options) {
  return find_visible(grid_of(field), tree, options, silent());
}
// Of the deepest tree over rough ground.
inline VisibleSets visible_over(int width, int depth) {
  return visible_over(rough_ground(width, depth), BisectionTree::over(width, depth), few_cells());
}
inline VisibilityTable table_over(int width, int depth) { return changes_of(visible_over(width, depth)); }

}  // namespace terrabench
