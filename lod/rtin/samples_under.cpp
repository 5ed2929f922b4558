#include "lod/rtin/samples_under.h"

#include <algorithm>
#include <cmath>

namespace terrabench::rtin {
namespace {

struct Plane {
  glm::dvec2 origin;
  double height;  // at the origin
  double along_x, along_z;
};

Plane plane_of(const std::array<glm::ivec2, 3>& corners, const std::array<double, 3>& heights, double area) {
  const glm::dvec2 ab = corners[1] - corners[0], ac = corners[2] - corners[0];
  const double up_b = heights[1] - heights[0], up_c = heights[2] - heights[0];
  return {corners[0], heights[0], (up_b * ac.y - up_c * ab.y) / area, (up_c * ab.x - up_b * ac.x) / area};
}

// Where an edge crosses rows.
struct Edge {
  Edge(glm::ivec2 from, glm::ivec2 to)
      : start(from), slope(from.y == to.y ? 0 : static_cast<double>(to.x - from.x) / (to.y - from.y)) {}
  double at(int row) const { return start.x + slope * (row - start.y); }
  glm::dvec2 start;
  double slope;
};

// Written so that the compiler vectorises it.
void measure_row(const float* heights, int samples, double height, double along_x, SamplesUnder& under) {
  double error = under.error;
  float lowest = under.lowest, highest = under.highest;
  for (int i = 0; i < samples; ++i) {
    const double off = std::abs(heights[i] - (height + along_x * i));
    error = error < off ? off : error;
  }
  for (int i = 0; i < samples; ++i) {
    lowest = heights[i] < lowest ? heights[i] : lowest;
    highest = highest < heights[i] ? heights[i] : highest;
  }
  under = {error, lowest, highest};
}

}  // namespace

// Row by row, from the lesser to the greater of two edges' crossings. A crossing is a fraction with the rows
// of an edge as its denominator, so that one beside a sample is further from it than the tolerance.
SamplesUnder samples_under(const GroundGrid& grid, const std::array<glm::ivec2, 3>& corners) {
  constexpr double kTolerance = 1e-6;
  const auto row = [&](int z) { return &grid.heights[static_cast<std::size_t>(z) * grid.width]; };
  const auto height = [&](glm::ivec2 at) { return row(at.y)[at.x]; };
  SamplesUnder under{0, height(corners[0]), height(corners[0])};
  const glm::dvec2 ab = corners[1] - corners[0], ac = corners[2] - corners[0];
  const double area = ab.x * ac.y - ab.y * ac.x;
  if (area == 0) return under;
  const Plane plane = plane_of(corners, {height(corners[0]), height(corners[1]), height(corners[2])}, area);
  std::array<glm::ivec2, 3> down = corners;
  std::sort(down.begin(), down.end(), [](glm::ivec2 p, glm::ivec2 q) { return p.y < q.y; });
  const Edge whole(down[0], down[2]), upper(down[0], down[1]), lower(down[1], down[2]);
  for (int z = down[0].y; z <= down[2].y; ++z) {
    const auto [left, right] = std::minmax({whole.at(z), (z < down[1].y ? upper : lower).at(z)});
    const int first = static_cast<int>(left + (1 - kTolerance)), last = static_cast<int>(right + kTolerance);
    const double start =
        plane.height + plane.along_x * (first - plane.origin.x) + plane.along_z * (z - plane.origin.y);
    measure_row(row(z) + first, last - first + 1, start, plane.along_x, under);
  }
  return under;
}

}  // namespace terrabench::rtin
