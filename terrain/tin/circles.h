// Exact tests with circles, for Delaunay.
#pragma once

#include "terrain/tin/delaunay.h"

namespace terrabench::tin {

__extension__ typedef __int128 Wide;  // holds in_circle() of sides up to 2¹⁶

// The sign of q's power over the circle through p, b and c: positive inside.
inline int in_circle(Sample p, Sample b, Sample c, Sample q) {
  struct Offset {
    std::int64_t x, y, square;
    Offset(Sample a, Sample from)
        : x(std::int64_t{a.i} - from.i), y(std::int64_t{a.j} - from.j), square(x * x + y * y) {}
  };
  const Offset u(p, q), v(b, q), w(c, q);
  const std::int64_t vw = v.x * w.y - v.y * w.x, wu = w.x * u.y - w.y * u.x, uv = u.x * v.y - u.y * v.x;
  const auto sign = [](auto power) { return power > 0 ? 1 : power < 0 ? -1 : 0; };
  // Below 2²⁹ each of the three products is below 2⁵⁸.
  if ((u.square | v.square | w.square) < std::int64_t{1} << 29)
    return sign(u.square * vw + v.square * wu + w.square * uv);
  return sign(static_cast<Wide>(u.square) * vw + static_cast<Wide>(v.square) * wu +
              static_cast<Wide>(w.square) * uv);
}

// Whether the diagonal pq of four points on one circle is preferred to bc.
inline bool prefers(Sample p, Sample q, Sample b, Sample c) {
  const Sample first = before(b, c) ? b : c;
  return before(p, first) || before(q, first);
}

// Whether the triangulation of these four cannot have the triangle (a, b, c).
inline bool in_conflict(Sample a, Sample b, Sample c, Sample q) {
  const int side = in_circle(a, b, c, q);
  if (side != 0) return side > 0;
  if (twice_area(a, b, q) < 0) return prefers(c, q, a, b);
  if (twice_area(b, c, q) < 0) return prefers(a, q, b, c);
  if (twice_area(c, a, q) < 0) return prefers(b, q, c, a);
  return false;  // a corner
}

// The index is one of the three.
inline int place_of(const std::array<std::uint32_t, 3>& indices, std::uint32_t index) {
  return indices[0] == index ? 0 : indices[1] == index ? 1 : 2;
}

}  // namespace terrabench::tin
