// The height of the drawn surface at every sample of the full terrain. Triangles include their edges, so a
// sample on a shared edge or vertex is never missed. Heights along an edge are interpolated from its two ends
// only, so both sides of an edge without a crack give the same bits. Where triangles disagree (cracks,
// overlaps), the highest one counts, which is visible from above; the result does not depend on the order of
// drawing or the number of threads. Triangles without plan area (skirts) draw nothing, nor do triangles that
// are clockwise from above. O(triangles + samples drawn), in parallel.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "lod/plan_triangle.h"
#include "terrain/frame.h"

namespace terrabench {

// The triangles that a frame draws, with corners by sample of the full terrain, for the meters of ground that
// is a heightfield. Every method's vertices lie over samples there (terrain/frame.h), so plan positions are
// integers and all plan geometry is exact. Vertices of meshes in space count as lying over the nearest
// sample; for ground with overhangs see openings.h. O(triangles), in parallel.

// Calls use() with blocks of corners, three per triangle, from many threads at once and in any order.
void for_drawn_triangles(const Frame&, const std::function<void(std::span<const Corner>)>& use);

class SurfaceRaster {
 public:
  // For terrain of width × depth samples; samples outside are ignored.
  SurfaceRaster(int width, int depth);
  SurfaceRaster(const Frame&, int width, int depth);

  // Replaces the surface; allocates nothing.
  void draw(const Frame&);

  int width() const { return width_; }
  int depth() const { return depth_; }
  // NaN where nothing is drawn.
  float at(int i, int j) const { return heights_[static_cast<std::size_t>(j) * width_ + i]; }
  bool is_drawn(int i, int j) const { return at(i, j) == at(i, j); }

 private:
  int width_, depth_;
  std::vector<float> heights_;
};

}  // namespace terrabench
