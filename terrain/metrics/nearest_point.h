// Exact nearest neighbours in space: a balanced k-d tree (Bentley 1975) without nodes, in which the median of
// every part of one flat array splits it along the part's longest side.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace terrabench {

using SpacePoint = std::array<double, 3>;

class NearestPoint {
 public:
  // O(n log n). May be empty.
  explicit NearestPoint(std::vector<SpacePoint> points);

  // Squared distance to the nearest point; infinite when there are none. O(log n) for points spread over a
  // surface. Thread-safe.
  double squared_distance(const SpacePoint& from) const;

 private:
  void build(std::size_t begin, std::size_t end);
  void search(std::size_t begin, std::size_t end, const SpacePoint& from, double& best) const;

  std::vector<SpacePoint> points_;
  std::vector<std::uint8_t> axes_;  // the axis along which each point splits its part
};

}  // namespace terrabench
