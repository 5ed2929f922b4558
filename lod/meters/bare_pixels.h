// Detects openings in the drawn surface by what is seen through them, for ground of any shape: pixels whose
// line of sight is in the ground although it has not entered it, where the sky or an inside would show.
//
// Along the line of sight of each pixel's centre, from the eye to the border of the ground's extent, all
// triangles seen from the air count +1 and all seen from the ground -1. For a surface without openings the
// sum is 1 when the line leaves the extent below the border, and 0 above it, however often it enters and
// leaves hills on its way. So openings count that something nearer hides, too; and where caves taper to
// nothing, it does not matter which of the surfaces that lie on each other is nearer. A triangle covers a
// centre on its edge by one rule for all triangles, so edges shared by two count once.
#pragma once

#include <cstddef>

#include "terrain/frame.h"
#include "terrain/heightfield.h"
#include "terrain/view.h"

namespace terrabench {

struct BarePixels {
  std::size_t bare = 0;     // an upper side is missing
  std::size_t covered = 0;  // there is one too many: surfaces over each other
  std::size_t total() const { return bare + covered; }
};

// For a frame over ground of this extent, of whose heights only those along the border are read. Within two
// pixels of the border, and where a coarse level may draw it higher or lower than the heights, both sums are
// right. The far plane should lie beyond the ground. O(triangles + pixels
// they cover), in parallel. Throws usage_error when the eye is not over the extent.
BarePixels find_bare_pixels(const Frame&, const Heightfield& ground, const View&);

}  // namespace terrabench
