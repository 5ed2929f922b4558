// Triangles whose corners are samples of the full terrain, and the samples that lie on them. Plan positions
// are integers, so the decision which samples lie on a triangle is exact.
#pragma once

#include <algorithm>
#include <numeric>
#include <utility>

namespace terrabench {

struct Corner {
  int x = 0, z = 0;  // samples
  float y = 0;       // metres
  bool operator==(const Corner&) const = default;
};

// Twice the triangle's area in plan, in samples²; positive when counter-clockwise from above, as in a Batch.
inline long long doubled_plan_area(const Corner* triangle) {
  const Corner &a = triangle[0], &b = triangle[1], &c = triangle[2];
  return static_cast<long long>(b.z - a.z) * (c.x - a.x) - static_cast<long long>(b.x - a.x) * (c.z - a.z);
}

namespace plan_triangle {

inline long long floor_divide(long long a, long long b) {  // b > 0
  return a / b - (a % b < 0 ? 1 : 0);
}

// Visits the samples on the edge from `from` up to but not including `to`, which the next edge visits.
// Interpolates from the lesser end, independent of the edge's direction.
template <class Use>
void visit_edge(const Corner& from, const Corner& to, const Use& use) {
  use(to.x, to.z, to.y);
  const int parts = std::gcd(to.x - from.x, to.z - from.z);
  if (parts < 2) return;
  const bool forward = std::pair(from.x, from.z) < std::pair(to.x, to.z);
  const Corner &low = forward ? from : to, &high = forward ? to : from;
  const int step_x = (high.x - low.x) / parts, step_z = (high.z - low.z) / parts;
  for (int k = 1; k < parts; ++k) {
    const double y = low.y + (static_cast<double>(high.y) - low.y) * k / parts;
    use(low.x + k * step_x, low.z + k * step_z, static_cast<float>(y));
  }
}

// Visits the samples strictly inside, row by row; the area must be positive.
template <class Use>
void visit_inside(const Corner* corners, long long area, int width, int depth, const Use& use) {
  const Corner &a = corners[0], &b = corners[1], &c = corners[2];
  const auto [first, last] = std::minmax({a.z, b.z, c.z});
  if (last - first < 2 || std::max({a.x, b.x, c.x}) - std::min({a.x, b.x, c.x}) < 2) return;
  const double rise_b = static_cast<double>(b.y) - a.y, rise_c = static_cast<double>(c.y) - a.y;
  const double along_x = ((b.z - a.z) * rise_c - (c.z - a.z) * rise_b) / static_cast<double>(area);
  const double along_z = ((c.x - a.x) * rise_b - (b.x - a.x) * rise_c) / static_cast<double>(area);
  for (int z = std::max(first + 1, 0); z < std::min(last, depth); ++z) {
    long long low = 0, high = width - 1;
    for (int e = 0; e < 3; ++e) {
      const Corner &p = corners[e], &q = corners[(e + 1) % 3];
      // Inside: (q.z - p.z)·(x - p.x) > (q.x - p.x)·(z - p.z).
      const long long slope = q.z - p.z, limit = static_cast<long long>(q.x - p.x) * (z - p.z);
      if (slope > 0) low = std::max(low, p.x + floor_divide(limit, slope) + 1);
      if (slope < 0) high = std::min(high, p.x - floor_divide(limit, -slope) - 1);
    }
    const double row = a.y + along_z * (z - a.z);
    for (long long x = low; x <= high; ++x) {
      use(static_cast<int>(x), z, static_cast<float>(row + along_x * static_cast<double>(x - a.x)));
    }
  }
}

}  // namespace plan_triangle

// Calls use(x, z, height) for every sample on the triangle, edges and corners included; not at all for a
// triangle without plan area. Heights along an edge depend only on its two ends, so both triangles beside it
// give the same bits. Samples outside width × depth are omitted inside the triangle, but not on its edges.
// O(samples).
template <class Use>
void for_samples_on(const Corner* corners, int width, int depth, const Use& use) {
  const long long area = doubled_plan_area(corners);
  if (area == 0) return;
  for (int e = 0; e < 3; ++e) plan_triangle::visit_edge(corners[e], corners[(e + 1) % 3], use);
  if (area > 0) {
    plan_triangle::visit_inside(corners, area, width, depth, use);
  } else {
    const Corner turned[] = {corners[0], corners[2], corners[1]};
    plan_triangle::visit_inside(turned, -area, width, depth, use);
  }
}

}  // namespace terrabench
