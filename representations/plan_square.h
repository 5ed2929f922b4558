// The ground over a square between four samples, as rays meet it: two triangles between the heights at its
// corners, which meet along the diagonal from the north-eastern to the south-western corner. For ray_walk.h.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "representations/ray_walk.h"

namespace terrabench {

// Heights, metres; one that is NaN leaves the square without ground.
struct CornerHeights {
  float nw, ne, sw, se;
  bool none() const { return std::isnan(nw + ne + sw + se); }
  float highest() const { return std::max(std::max(nw, ne), std::max(sw, se)); }
};

// A ray over a square whose sides are 1: its position, and its height over the planes of the square's two
// triangles, are linear in t. The triangles meet along u + v = 1.
class PlanSquare {
 public:
  // The square of cell (i, j) between the planes of two axes.
  PlanSquare(const PlanAxis& x, const PlanAxis& z, int i, int j, const CornerHeights& c, const RayPath& path)
      : y0_(path.origin.y), dy_(path.direction.y), nw_(c.nw), ne_(c.ne), sw_(c.sw), se_(c.se) {
    const double per_x = per_width(x, i), per_z = per_width(z, j);
    u0_ = (path.origin.x - x.plane(i)) * per_x;
    du_ = path.direction.x * per_x;
    v0_ = (path.origin.z - z.plane(j)) * per_z;
    dv_ = path.direction.z * per_z;
  }

  bool below(double t) const { return above(t) < 0; }
  // Metres above the ground, negative in the solid.
  double above(double t) const { return above(past_diagonal(t) < 0, t); }

  // The first t in the stretch at which below(t) differs from `inside`; infinite if there is none.
  double change(Stretch at, bool inside) const {
    const double first = past_diagonal(at.begin), last = past_diagonal(at.end);
    if ((above(first < 0, at.begin) < 0) != inside) return at.begin;
    if (first * last >= 0) return change(first + last < 0, at, inside);
    const double middle = at.begin + (at.end - at.begin) * (first / (first - last));
    const double hit = change(first < 0, {at.begin, middle}, inside);
    return hit < kNone ? hit : change(last < 0, {middle, at.end}, inside);
  }

 private:
  static constexpr double kNone = std::numeric_limits<double>::infinity();

  static double per_width(const PlanAxis& axis, int k) {
    return k > 0 && k + 1 < axis.cells ? axis.per_cell : 1 / (axis.plane(k + 1) - axis.plane(k));
  }
  double past_diagonal(double t) const { return u0_ + t * du_ + (v0_ + t * dv_) - 1; }
  // Above the plane of the north-western triangle, or of the other.
  double above(bool north_west, double t) const {
    const double u = u0_ + t * du_, v = v0_ + t * dv_, y = y0_ + t * dy_;
    return y - (north_west ? nw_ + u * (ne_ - nw_) + v * (sw_ - nw_)
                           : se_ + (1 - u) * (sw_ - se_) + (1 - v) * (ne_ - se_));
  }
  double change(bool north_west, Stretch at, bool inside) const {
    const double last = above(north_west, at.end);
    if ((last < 0) == inside) return kNone;
    const double first = above(north_west, at.begin);
    if ((first < 0) != inside) return at.begin;
    return std::clamp(at.begin + (at.end - at.begin) * (first / (first - last)), at.begin, at.end);
  }

  double u0_, du_, v0_, dv_, y0_, dy_;  // position at t: u0 + t · du
  double nw_, ne_, sw_, se_;
};

}  // namespace terrabench
