// One traversal of the tree for one view (MRBSP paper, §3 and §4) chooses the triangles to draw. It skips
// nodes outside the view frustum and hidden nodes (visibility/change_table.h). lod_rule.h says how deep it
// descends, and where it splits a triangle further to avoid a hole. O(triangles drawn).
//
// For a field that is not a square of 2^k + 1 samples, the tree's square extends beyond the field, and
// vertices outside are clamped to the field's border. Clamping keeps the order in x and in z, so the
// triangles still cover the field once; triangles without plan area are left out.
#pragma once

#include <cstdint>
#include <vector>

#include "lod/mrbsp/bisection_tree.h"
#include "lod/mrbsp/lod_rule.h"
#include "lod/mrbsp/triangle_bounds.h"
#include "lod/mrbsp/visibility/change_table.h"
#include "terrain/frame.h"
#include "terrain/frustum.h"

namespace terrabench {

// A triangle that the LOD rule does not split, kept until all split vertices are known.
struct PendingTriangle {
  std::uint64_t apex, left, right;  // vertices: x + y · 2³²
  std::uint32_t node;
  unsigned planes;  // of the frustum, that the triangle may cross
};

struct WalkGround {
  const GroundGrid& grid;
  const BisectionTree& tree;
  const TriangleBounds& bounds;
};
struct WalkEye {
  glm::vec3 at;
  const Frustum* frustum;                 // null: nothing is culled by the view
  const mrbsp::visibility::Flags* flags;  // null: nothing is hidden
};
// Buffers reused between frames; empty before and after a walk.
struct WalkScratch {
  SplitVertices* splits;  // null: not the conforming hole rule
  std::vector<PendingTriangle>& pending;
  bool printed_rule;  // without `splits`; false: no hole rule
};

// Appends the vertices of the triangles to draw, three per triangle, to `out`.
void walk_tree(const WalkGround&, const LodRule&, const WalkEye&, const WalkScratch&,
               std::vector<std::uint32_t>& out);

}  // namespace terrabench
