// Ground height at a position, for eyes that stand on the ground.
#pragma once

#include "lod/mrbsp/bisection_tree.h"
#include "terrain/frame.h"

namespace terrabench {

// Bilinear interpolation of the four samples around (x, z), which are in samples and inside the field. O(1).
float sample_height(const GroundGrid&, float x, float z);

// Height of the tree's finest triangles at (x, z) in metres, clamped to the field. The triangles do not use
// all samples at even depths, so an eye placed by the samples alone may be below them. In a triangle that
// extends beyond the field, the height of its highest corner. O(depth).
float surface_height(const BisectionTree&, const GroundGrid&, float x, float z);

}  // namespace terrabench
