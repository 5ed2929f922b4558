// The triangles that a frame draws, on the lattice of the full terrain's samples: what the meters read. A
// vertex of every method stands over a sample (terrain/frame.h), so its plan position is two whole numbers
// and all plan geometry is exact. O(triangles), in parallel.
#pragma once

#include <functional>
#include <span>

#include "lod/plan_triangle.h"
#include "terrain/frame.h"

namespace terrabench {

// Hands over corners, three a triangle, in blocks, from many threads at once and in any order.
void for_drawn_triangles(const Frame&, const std::function<void(std::span<const Corner>)>& use);

}  // namespace terrabench
