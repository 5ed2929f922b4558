// What is drawn over itself: the samples of the full terrain that more than one triangle covers in plan.
//
// A sample on an edge belongs to the triangle on one side of it alone, a sample at a corner to one of those
// around it, by one rule for all; so a surface without overlaps covers no sample twice, whatever its
// triangles, T-junctions included. Exact. Triangles without plan area (skirts) cover nothing, and those that
// wind the wrong way cover as others do. O(triangles + rows that they cross), in parallel; one bit a sample.
#pragma once

#include <cstddef>

#include "terrain/frame.h"

namespace terrabench {

// Of a frame over terrain of width × depth samples: how often a sample was covered before.
std::size_t samples_covered_again(const Frame&, int width, int depth);

}  // namespace terrabench
