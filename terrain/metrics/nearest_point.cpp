#include "terrain/metrics/nearest_point.h"

#include <algorithm>
#include <limits>

namespace terrabench {
namespace {

// Parts of at most so many points are searched linearly.
constexpr std::size_t kLeaf = 8;

double squared_distance(const SpacePoint& a, const SpacePoint& b) {
  const double x = a[0] - b[0], y = a[1] - b[1], z = a[2] - b[2];
  return x * x + y * y + z * z;
}

}  // namespace

NearestPoint::NearestPoint(std::vector<SpacePoint> points)
    : points_(std::move(points)), axes_(points_.size()) {
  build(0, points_.size());
}

void NearestPoint::build(std::size_t begin, std::size_t end) {
  if (end - begin <= kLeaf) return;
  SpacePoint low = points_[begin], high = low;
  for (std::size_t i = begin; i < end; ++i) {
    for (int k = 0; k < 3; ++k) {
      low[k] = std::min(low[k], points_[i][k]);
      high[k] = std::max(high[k], points_[i][k]);
    }
  }
  std::uint8_t axis = 0;
  for (std::uint8_t k = 1; k < 3; ++k) {
    if (high[k] - low[k] > high[axis] - low[axis]) axis = k;
  }
  const std::size_t middle = begin + (end - begin) / 2;
  const auto at = [&](std::size_t i) { return points_.begin() + static_cast<std::ptrdiff_t>(i); };
  std::nth_element(at(begin), at(middle), at(end),
                   [=](const SpacePoint& a, const SpacePoint& b) { return a[axis] < b[axis]; });
  axes_[middle] = axis;
  build(begin, middle);
  build(middle + 1, end);
}

double NearestPoint::squared_distance(const SpacePoint& from) const {
  double best = std::numeric_limits<double>::infinity();
  search(0, points_.size(), from, best);
  return best;
}

void NearestPoint::search(std::size_t begin, std::size_t end, const SpacePoint& from, double& best) const {
  if (end - begin <= kLeaf) {
    for (std::size_t i = begin; i < end; ++i) {
      best = std::min(best, terrabench::squared_distance(points_[i], from));
    }
    return;
  }
  const std::size_t middle = begin + (end - begin) / 2;
  const SpacePoint& split = points_[middle];
  best = std::min(best, terrabench::squared_distance(split, from));
  const double across = from[axes_[middle]] - split[axes_[middle]];
  const bool before = across < 0;
  search(before ? begin : middle + 1, before ? middle : end, from, best);
  if (across * across < best) search(before ? middle + 1 : begin, before ? end : middle, from, best);
}

}  // namespace terrabench
