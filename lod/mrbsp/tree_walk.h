// One walk down the tree for one view (MRBSP paper, §3 and §4): which triangles are drawn. Left out is what
// the view does not see and what the ground hides; lod_rule.h says how deep it goes, hole_rule.h where it
// goes on although distance would not. O(triangles drawn).
//
// Any field: the tree's square reaches over its far borders, and vertices out there stand on the border. That
// keeps order and orientation in x and in z, so the triangles still cover the field once; the flat ones are
// left out.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "lod/mrbsp/bisection_tree.h"
#include "lod/mrbsp/hole_rule.h"
#include "lod/mrbsp/lod_rule.h"
#include "lod/mrbsp/triangle_bounds.h"
#include "lod/mrbsp/visible_flags.h"
#include "terrain/frame.h"
#include "terrain/frustum.h"

namespace terrabench {

// A triangle that distance leaves whole, until all cuts are known.
struct WholeTriangle {
  std::array<std::uint16_t, 2> apex, left, right;  // lattice
  std::uint32_t node;
  unsigned planes;  // of the view, that it may cross
};

struct WalkGround {
  const GroundGrid& grid;
  const BisectionTree& tree;
  const TriangleBounds& bounds;
};
struct WalkEye {
  glm::vec3 at;
  const Frustum* frustum;     // null: nothing is left out for the view
  const VisibleFlags* flags;  // null: nothing is hidden
};
// Kept from frame to frame to save allocations: empty before and after.
struct WalkScratch {
  Cuts* cuts;  // null: holes are kept out by the printed rule
  std::vector<WholeTriangle>& whole;
};

// Appends the vertices of the triangles to draw, three a triangle, to `out`.
void walk_tree(const WalkGround&, const LodRule&, const WalkEye&, const WalkScratch&,
               std::vector<std::uint32_t>& out);

}  // namespace terrabench
