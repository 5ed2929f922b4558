// How high the ground lies under a place: what eyes are put on.
#pragma once

#include "lod/mrbsp/bisection_tree.h"
#include "terrain/frame.h"

namespace terrabench {

// Between the four samples around a place, bilinear: x and z in samples, inside the field. O(1).
float sample_height(const GroundGrid&, float x, float z);

// Height of the finest triangles at a place in metres, drawn in to the field. They leave samples out at even
// depths, so that a walker put on the samples alone may stand under them. In triangles that reach over the
// field's far borders: of the highest corner. O(depth).
float surface_height(const BisectionTree&, const GroundGrid&, float x, float z);

}  // namespace terrabench
