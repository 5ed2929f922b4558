// Heights on a lattice as bytes, with a largest error that is stated: near-lossless coding as in JPEG-LS
// (Weinberger, Seroussi & Sapiro 2000), with blended predictors (Seemann & Tischer 1997) and adaptive range
// coding. Each height is rounded to a multiple of a step, predicted from coded neighbours to the west and
// north, and the difference coded with statistics for its surroundings: rough ground does not spoil smooth
// ground.
#pragma once

#include <span>
#include <vector>

#include "terrain/files.h"

namespace terrabench {

// The step for this largest error, ≥ 0 m. Heights that are all multiples of a common unit, as metres or
// decimetres of most DEMs, allow a longer one: whole metres to within 1 m are multiples of 3. Error 0 keeps
// heights that have such a unit; others lose what lies below 2⁻²⁰ of their range. O(n).
double step_for(std::span<const float> heights, double largest_error);

// Row-major, `width` to a row; NaN where there is no data, which is kept exactly. O(n), about 0.1 µs a
// height.
void encode_heights(std::span<const float> heights, int width, double step, ByteSink& out);
// Throws bad_input for bytes that encode_heights() cannot have written for so many heights.
std::vector<float> decode_heights(ByteSource& in, int width, int depth);
// Clamps heights to the range that they had before they were rounded.
void clamp_heights(std::span<float> heights, float lowest, float highest);

}  // namespace terrabench
