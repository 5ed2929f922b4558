// What the triangles of longest-edge bisection are chosen by, as plain data: lod/cbt/ makes it, and
// renderers/cbt/ chooses by it on the GPU. It stands between the two as frame.h does for triangles that were
// chosen.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <span>
#include <vector>

#include "terrain/frame.h"

namespace terrabench {

// Root squares of 2^side_log cells, two triangles each, that cover the grid from sample (0, 0) on; lattice
// points beyond the last row or column lie over it (lod/rtin/lattice.h).
struct SplitGround {
  GroundGrid grid;
  glm::ivec2 roots{1};  // squares along x and z
  int side_log = 0;
  int depth = 0;  // level of the finest triangles in the tree
  // Per lattice point, row by row, metres: nested errors and the radii of nested spheres
  // (lod/rtin/nested_errors.h).
  std::vector<float> errors, radii;
  std::span<const std::uint64_t> tree;  // words of cbt::BitTree: the triangles to begin with
};

// The terms of ScreenBound (lod/screen_bound.h).
struct BoundTerms {
  glm::dvec3 eye, forward;
  double pixels, focal, near, secant;
};

// Of one view: a triangle is split if it is in the frustum and its nested error exceeds what the bound allows
// in its nested sphere.
struct SplitRule {
  BoundTerms bound;
  std::array<glm::dvec4, 6> planes;  // Frustum::planes()
};

}  // namespace terrabench
