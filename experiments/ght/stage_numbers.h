// Numbers that a reader can take from figures 1 and 3 to 10 of "ght", measured on what is drawn.
#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include "terrain/heightfield.h"
#include "terrain/image.h"
#include "terrain/mesh.h"

namespace terrabench::ght {

// How many different values there are.
template <class T>
double different(std::vector<T> values) {
  std::sort(values.begin(), values.end());
  return static_cast<double>(std::unique(values.begin(), values.end()) - values.begin());
}

// The samples at even columns of even rows; both sides are odd.
Heightfield every_other(const Heightfield&);

// The correlation of the greys of a heightmap with the heights of a mesh over it, whose vertices stand at
// samples `cell` metres apart. O(vertices)
double correlation(const Image& map, const TriangleMesh& mesh, double cell);

// How many points of an earlier line the later one has elsewhere. The earlier one has two points or more; the
// later one has a whole number of steps for each of its steps.
double moved_points(const std::vector<float>& earlier, const std::vector<float>& later);

// The mean distance of the points of a level from the middle of their neighbours, level 1 being the first, in
// a line of midpoint displacement.
double mean_displacement(const std::vector<float>& line, int level);

// How many of the four neighbours of a point, diagonal or straight ones, are among the corners, in an array
// of 5 × 5 whose last row and column are the first.
using Cells = std::vector<std::pair<int, int>>;
double neighbours_among(const Cells& corners, std::pair<int, int> centre, bool diagonal);

// How far from sample (i, j) the ground is above 0, in samples.
double raised_within(const Heightfield&, int i, int j);

}  // namespace terrabench::ght
