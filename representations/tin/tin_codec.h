// A TIN as bytes: which samples are vertices, a bit each with the statistics of its surroundings, and their
// heights, each the difference from the surface of the vertices before it. The triangles follow from the
// vertices (delaunay.h), so that connectivity takes nothing.
#pragma once

#include "terrain/files.h"
#include "terrain/tin/greedy_insertion.h"

namespace terrabench::tin {

// Heights become multiples of `step` metres above the lowest. `surface` is in order. O(samples + vertices).
void encode(const Approximation& surface, int width, int depth, double step, ByteSink&);
// Throws bad_input for bytes that encode() cannot have written. In order.
Approximation decode(ByteSource&, int width, int depth);

}  // namespace terrabench::tin
