// Greedy insertion (Garland & Heckbert 1995, "Fast polygonal approximation of terrains and height fields",
// algorithm III): of all samples the one that the triangulation misses by most becomes its next vertex, until
// no sample is missed by more than the largest error.
//
// To use all cores, samples are inserted in passes: one per triangle that misses more than the pass's limit,
// which falls toward the largest error. Each pass scans only triangles that the last one changed. Between two
// samples of equal error the first in rows counts, so that every number of threads gives the same vertices.
#pragma once

#include <span>

#include "terrain/heightfield.h"
#include "terrain/progress.h"
#include "terrain/tin/delaunay.h"

namespace terrabench::tin {

struct Approximation {
  Delaunay surface;
  std::vector<float> heights;       // of the vertices, metres; NaN for a corner of the rectangle without data
  std::vector<std::uint8_t> holes;  // per triangle 1 for no data; empty if all samples have data
};

// Delaunay::put_in_order(), with the heights and holes.
void put_in_order(Approximation&);

inline std::array<float, 3> corner_heights(const Triangle& t, const std::vector<float>& heights) {
  return {heights[t.vertex[0]], heights[t.vertex[1]], heights[t.vertex[2]]};
}

// In order. Every sample with data is met to within `largest_error` metres, ≥ 0. Squares of samples of which
// one has no data are holes: all samples on their rims become vertices, so that triangles lie wholly inside
// or outside. Needs 2 × 2 samples at least. O((samples + vertices) log vertices) for most ground.
Approximation greedy_insertion(const Heightfield&, float largest_error, Progress&);

}  // namespace terrabench::tin
