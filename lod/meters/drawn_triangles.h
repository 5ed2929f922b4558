// The triangles that a frame draws, with corners by sample of the full terrain, for the meters of ground that
// is a heightfield. Every method's vertices lie over samples there (terrain/frame.h), so plan positions are
// integers and all plan geometry is exact. Vertices of meshes in space count as lying over the nearest
// sample; for ground with overhangs see openings.h. O(triangles), in parallel.
#pragma once

#include <functional>
#include <span>

#include "lod/plan_triangle.h"
#include "terrain/frame.h"

namespace terrabench {

// Calls use() with blocks of corners, three per triangle, from many threads at once and in any order.
void for_drawn_triangles(const Frame&, const std::function<void(std::span<const Corner>)>& use);

}  // namespace terrabench
