// Exact Euclidean distance transform of a grid (Meijster, Roerdink & Hesselink 2000; Felzenszwalb &
// Huttenlocher 2012): a pass along columns, then along each row the lower envelope of one parabola per
// column. O(n) for any set of points; parallel.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace terrabench {

// The squared distance from each of width × depth grid points, spaced cell_x and cell_z, to the nearest of
// `points` (row-major indices, any order). All infinite when there are no points.
std::vector<double> squared_distances(int width, int depth, double cell_x, double cell_z,
                                      std::span<const std::uint32_t> points);

}  // namespace terrabench
