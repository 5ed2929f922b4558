// Visible sets over the ground of mrbsp_ground.h, for the visibility tests.
#pragma once

#include "lod/lod.h"
#include "lod/mrbsp/visibility/change_table.h"
#include "tests/lod/mrbsp_ground.h"

namespace terrabench::mrbsp::visibility {

inline Options few_cells(int cells = 8, int coarseness = 4, Mode mode = Mode::kConservative) {
  Options options;
  options.mode = mode;
  options.cells = cells;
  options.coarseness = coarseness;
  return options;
}

inline Sets visible_over(const Heightfield& field, const BisectionTree& tree, const Options& options) {
  return find_sets(grid_of(field), tree, options, silent());
}
// For the deepest tree over rough ground.
inline Sets visible_over(int width, int depth) {
  return visible_over(rough_ground(width, depth), BisectionTree::over(width, depth), few_cells());
}
inline ChangeTable table_over(int width, int depth) { return changes_of(visible_over(width, depth)); }

}  // namespace terrabench::mrbsp::visibility
