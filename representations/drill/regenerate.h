// Terrain from drills (Stuetzle & Franklin 2012, §2.3, eq. 1): each drill lowers the terrain to its shape in
// a square window around its pixel. The minimum of all shapes does not depend on their order: tiles are
// drilled in parallel, with the same result for any number of threads. (2k + 1)² minima per drill, in SIMD.
#pragma once

#include <cstddef>
#include <span>

#include "representations/drill/drills.h"
#include "terrain/heightfield.h"

namespace terrabench {

// Row-major heights of all pixels: the plateau where no drill reached, no-data in holes. Never interpolates.
void regenerate(const Drills& drills, std::span<float> heights);
// The same as a field, interpolated if drills.interpolated.
Heightfield regenerate(const Drills& drills);

// Whether a drill lowered the pixel. Untouched pixels may lie inside windows, where the shape is above the
// plateau.
inline bool is_touched(float height, const Drills& drills) { return height < drills.plateau; }
std::size_t count_untouched(const Drills& drills, std::span<const float> heights);

// §4.1: interpolates the pixels that no drill touched smoothly from the touched ones around them, by
// fill_no_data(). Does nothing when no pixel is touched. O(pixels).
void interpolate_untouched(const Drills& drills, Heightfield& heights);

}  // namespace terrabench
