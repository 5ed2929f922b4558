// Terrain from drills (Stuetzle & Franklin 2012, §2.3, eq. 1): each drill lowers what stands above its shape
// in a square window around its pixel. The least of all shapes is the same in any order, so that tiles are
// drilled in parallel and the result is the same for any number of threads. (2k + 1)² minima a drill, in
// SIMD.
#pragma once

#include <cstddef>
#include <span>

#include "representations/drill/drills.h"
#include "terrain/heightfield.h"

namespace terrabench {

// Row-major heights of all pixels: the plateau where no drill reached, no-data in holes. Never interpolates.
void regenerate(const Drills& drills, std::span<float> heights);
// The same as a field, interpolated when drills.interpolated.
Heightfield regenerate(const Drills& drills);

// Whether a drill lowered the pixel. Some that no drill touches may lie inside windows, higher up the shape
// than the plateau.
inline bool is_touched(float height, const Drills& drills) { return height < drills.plateau; }
std::size_t count_untouched(const Drills& drills, std::span<const float> heights);

// §4.1: gives pixels that no drill touched heights drawn smoothly from the touched ones around them, by
// fill_no_data(). Does nothing when no drill touched anything. O(pixels).
void interpolate_untouched(const Drills& drills, Heightfield& heights);

}  // namespace terrabench
