// The plane through three vertices, over positions in cells.
#pragma once

#include "terrain/tin/delaunay.h"

namespace terrabench::tin {

struct Plane {
  double height, per_i, per_j;  // at the corner `at`, and per cell
  Sample at;

  Plane(std::array<Sample, 3> p, std::array<float, 3> h) : height(h[0]), at(p[0]) {
    const double area = static_cast<double>(twice_area(p[0], p[1], p[2]));
    const double rise_1 = static_cast<double>(h[1]) - h[0], rise_2 = static_cast<double>(h[2]) - h[0];
    per_i = (rise_1 * (p[2].j - p[0].j) - rise_2 * (p[1].j - p[0].j)) / area;
    per_j = (rise_2 * (p[1].i - p[0].i) - rise_1 * (p[2].i - p[0].i)) / area;
  }
  double operator()(double i, double j) const { return height + per_i * (i - at.i) + per_j * (j - at.j); }
};

}  // namespace terrabench::tin
