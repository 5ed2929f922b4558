// Overlaps: the samples of the full terrain that more than one triangle covers in plan.
//
// By one rule for all triangles, a sample on an edge belongs to one side of it, and a sample at a corner to
// one of the triangles around it. So a surface without overlaps covers no sample twice, even with
// T-junctions. Exact. Triangles without plan area (skirts) cover nothing; clockwise ones cover like others.
// O(triangles + rows that they cross), in parallel; one bit per sample.
#pragma once

#include <cstddef>

#include "terrain/frame.h"

namespace terrabench {

// The number of repeated coverings in a frame over terrain of width × depth samples: a sample covered n times
// counts n - 1.
std::size_t samples_covered_again(const Frame&, int width, int depth);

}  // namespace terrabench
