// The samples of a triangle, and the one that its plane misses by most.
#pragma once

#include <algorithm>
#include <cmath>
#include <utility>

#include "terrain/tin/delaunay.h"

namespace terrabench::tin {

// Heights of a rectangle of samples in rows.
struct HeightsView {
  const float* first;
  int width;
  Sample north_west;  // of the rectangle
  const float* at(int i, int j) const {
    return first + std::ptrdiff_t{j - north_west.j} * width + (i - north_west.i);
  }
};

// A sample of a triangle that it misses by most.
struct Candidate {
  float error = 0;
  Sample at = {0, 0};
};

// Error 0 if the plane meets all. Planes are evaluated in floats: errors of kScanRounding times the greatest
// height. Of equal errors the first in rows counts. The triangle's samples have data.
Candidate worst_sample(const std::array<Sample, 3>&, const std::array<float, 3>& heights, const HeightsView&);
inline constexpr float kScanRounding = 0x1p-21F;

// The samples of a triangle by rows, but for corners that are alone in theirs.
class Rows {
 public:
  explicit Rows(std::array<Sample, 3> p) : p_(p) {
    const auto order = [&](std::size_t a, std::size_t b) {
      if (p_[b].j < p_[a].j) std::swap(p_[a], p_[b]);
    };
    order(0, 1);
    order(1, 2);
    order(0, 1);
    long_ = per_row(p_[0], p_[2]);
    upper_ = per_row(p_[0], p_[1]);
    lower_ = per_row(p_[1], p_[2]);
  }
  int first() const { return p_[0].j + (p_[0].j < p_[1].j ? 1 : 0); }
  int last() const { return p_[2].j - (p_[1].j < p_[2].j ? 1 : 0); }
  // Of row j, west ≤ east unless it has none.
  struct Columns {
    int west, east;
  };
  Columns columns(int j) const {
    const double one = p_[0].i + (j - p_[0].j) * long_;
    const double other = j < p_[1].j || p_[1].j == p_[2].j ? p_[0].i + (j - p_[0].j) * upper_
                                                           : p_[1].i + (j - p_[1].j) * lower_;
    // Truncation is floor() here: neither is under -kOnEdge.
    const double west = std::min(one, other) - kOnEdge;
    const int before = static_cast<int>(west);
    return {before + (west > before ? 1 : 0), static_cast<int>(std::max(one, other) + kOnEdge)};
  }

 private:
  // A sample that is not on an edge is at least 2⁻¹⁶ cells from it along its row; rounding moves an edge by
  // less than 2⁻³⁰.
  static constexpr double kOnEdge = 0x1p-20;

  static double per_row(Sample a, Sample b) {
    return a.j == b.j ? 0 : static_cast<double>(b.i - a.i) / (b.j - a.j);
  }

  std::array<Sample, 3> p_;      // from north to south
  double long_, upper_, lower_;  // columns per row of the edges
};

}  // namespace terrabench::tin
