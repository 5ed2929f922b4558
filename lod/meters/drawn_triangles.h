// The triangles that a frame draws, on the lattice of the full terrain's samples: what the meters read. A
// vertex of every method stands over a sample (terrain/frame.h), so its plan position is two whole numbers
// and all plan geometry is exact. O(triangles), in parallel.
#pragma once

#include <functional>
#include <span>

#include "terrain/frame.h"

namespace terrabench {

struct Corner {
  int x = 0, z = 0;  // samples
  float y = 0;       // metres
  bool operator==(const Corner&) const = default;
};

// Twice the area of the triangle's plan, in samples², positive for the winding that Batch asks for.
long long doubled_plan_area(const Corner* triangle);

// Hands over corners, three a triangle, in blocks, from many threads at once and in any order.
void for_drawn_triangles(const Frame&, const std::function<void(std::span<const Corner>)>& use);

}  // namespace terrabench
