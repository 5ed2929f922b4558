// The drawn surface seen in plan: its height at every sample of the full terrain. Triangles are closed, so
// that a sample on a shared edge or vertex is never missed; heights along an edge are interpolated between
// its two ends alone, so both sides of an edge without a crack give the same bits. Where triangles disagree
// (cracks, overlaps) the highest counts, which an eye in the air sees; so the result does not depend on the
// order of drawing nor on the number of threads. Triangles without plan area (skirts) draw nothing, and
// neither do those that wind clockwise from above, as on the screen.
// O(triangles + samples drawn), in parallel.
#pragma once

#include <vector>

#include "terrain/frame.h"

namespace terrabench {

class SurfaceRaster {
 public:
  // For terrain of width × depth samples; what lies outside is left out.
  SurfaceRaster(int width, int depth);
  SurfaceRaster(const Frame&, int width, int depth);

  // Replaces what was drawn before, in the same memory.
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
