#include "lod/mrbsp/nearest_three.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

#include "terrain/error.h"
#include "terrain/memory.h"

namespace terrabench {
namespace {

// The point of segment ab nearest to `at` in plan: its height and squared distance.
struct Nearest {
  float height, distance;
};
Nearest on_segment(const glm::vec3& a, const glm::vec3& b, glm::vec2 at) {
  const glm::vec2 along = in_plan(b) - in_plan(a), to = at - in_plan(a);
  const float length = glm::dot(along, along);
  const float t = length > 0 ? glm::clamp(glm::dot(to, along) / length, 0.0F, 1.0F) : 0;
  const glm::vec2 off = to - t * along;
  return {a.y * (1 - t) + b.y * t, glm::dot(off, off)};
}

}  // namespace

float ThreePoints::height(glm::vec2 at) const {
  const auto& [a, b, c] = point;
  if (count == 1 || distance[0] == 0) return a.y;
  if (count == 2) return on_segment(a, b, at).height;
  const float area = plan_cross(in_plan(b) - in_plan(a), in_plan(c) - in_plan(a));
  const float u = plan_cross(in_plan(b) - at, in_plan(c) - at),
              v = plan_cross(in_plan(c) - at, in_plan(a) - at);
  const float w = plan_cross(in_plan(a) - at, in_plan(b) - at);
  const bool inside = area > 0 ? std::min({u, v, w}) >= 0 : area < 0 && std::max({u, v, w}) <= 0;
  if (inside) {
    const float s = u / area, t = v / area;
    const float height = s * a.y + t * b.y + (1 - s - t) * c.y;
    return glm::clamp(height, std::min({a.y, b.y, c.y}), std::max({a.y, b.y, c.y}));
  }
  Nearest best = on_segment(a, b, at);
  for (const Nearest& other : {on_segment(b, c, at), on_segment(c, a, at)}) {
    if (other.distance < best.distance) best = other;
  }
  return best.height;
}

PlanExtent plan_extent(std::span<const glm::vec3> points) {
  if (points.empty() || points.size() > std::size_t{1} << 31) {
    throw usage_error(
        fmt::format("the number of height points must be from 1 to 2^31, got {}", points.size()), "",
        "give more points, or fewer");
  }
  constexpr float kFar = std::numeric_limits<float>::infinity();
  PlanExtent extent{glm::vec2(kFar), glm::vec2(-kFar)};
  for (const glm::vec3& p : points) {
    extent.low = glm::min(extent.low, in_plan(p));
    extent.high = glm::max(extent.high, in_plan(p));
  }
  return extent;
}

NearestThree::NearestThree(std::span<const glm::vec3> points) {
  const PlanExtent extent = plan_extent(points);
  low_ = extent.low;
  const glm::vec2 size = extent.high - extent.low;
  // For points in one line or at one position, the buckets form a line or there is only one.
  constexpr float kPointsPerBucket = 2, kMostAlong = 1 << 14;
  const float count = static_cast<float>(points.size());
  const float longest = std::max(size.x, size.y);
  side_ = std::max(std::sqrt(size.x * size.y * kPointsPerBucket / count), longest * kPointsPerBucket / count);
  side_ = std::max(side_, longest / kMostAlong);
  if (!(side_ > 0)) side_ = 1;
  columns_ = static_cast<int>(size.x / side_) + 1;
  rows_ = static_cast<int>(size.y / side_) + 1;

  const auto bucket = [&](const glm::vec3& p) {
    return static_cast<std::size_t>(bucket_z(p.z)) * columns_ + bucket_x(p.x);
  };
  first_.assign(static_cast<std::size_t>(columns_) * rows_ + 1, 0);
  for (const glm::vec3& p : points) ++first_[bucket(p) + 1];
  for (std::size_t b = 1; b < first_.size(); ++b) first_[b] += first_[b - 1];
  points_.resize(points.size());
  order_.resize(points.size());
  std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const std::uint32_t at = next[bucket(points[i])]++;
    points_[at] = points[i];
    order_[at] = static_cast<std::uint32_t>(i);
  }
}

int NearestThree::bucket_x(float x) const {
  return static_cast<int>(glm::clamp((x - low_.x) / side_, 0.0F, static_cast<float>(columns_ - 1)));
}
int NearestThree::bucket_z(float z) const {
  return static_cast<int>(glm::clamp((z - low_.y) / side_, 0.0F, static_cast<float>(rows_ - 1)));
}

float NearestThree::height(float x, float z) const {
  const int bx = bucket_x(x), bz = bucket_z(z);
  ThreePoints near;
  const auto search = [&](int i0, int i1, int j) {
    if (j < 0 || j >= rows_) return;
    i0 = std::max(i0, 0);
    i1 = std::min(i1, columns_ - 1);
    if (i0 > i1) return;
    const std::size_t row = static_cast<std::size_t>(j) * columns_;
    for (std::uint32_t k = first_[row + i0]; k < first_[row + i1 + 1]; ++k) {
      const glm::vec2 to = in_plan(points_[k]) - glm::vec2(x, z);
      near.offer(glm::dot(to, to), order_[k], points_[k]);
    }
  };
  search(bx - 1, bx + 1, bz - 1);
  search(bx - 1, bx + 1, bz);
  search(bx - 1, bx + 1, bz + 1);
  // Points beyond ring r of buckets are at least r·side + margin away. A position outside all buckets is
  // farther still from them.
  const glm::vec2 in_bucket((x - low_.x) - static_cast<float>(bx) * side_,
                            (z - low_.y) - static_cast<float>(bz) * side_);
  const float margin =
      std::max(0.0F, std::min({in_bucket.x, in_bucket.y, side_ - in_bucket.x, side_ - in_bucket.y}));
  const int last = std::max(columns_, rows_);
  for (int r = 1; r < last; ++r) {
    // Slightly less, so that rounding cannot skip a point as near as the third.
    const float reach = (static_cast<float>(r) * side_ + margin) * 0.9999F;
    if (near.count == 3 && near.distance[2] < reach * reach) break;
    const int ring = r + 1;
    search(bx - ring, bx + ring, bz - ring);
    search(bx - ring, bx + ring, bz + ring);
    for (int j = bz - ring + 1; j < bz + ring; ++j) {
      search(bx - ring, bx - ring, j);
      search(bx + ring, bx + ring, j);
    }
  }
  return near.height({x, z});
}

std::vector<glm::vec3> height_points(const Heightfield& field) {
  require_memory(field.heights.size() * (sizeof(glm::vec3) + NearestThree::kBytesPerPoint), "height points");
  std::vector<glm::vec3> points(field.heights.size());
  tbb::parallel_for(0, field.depth, [&](int j) {
    for (int i = 0; i < field.width; ++i) {
      points[static_cast<std::size_t>(j) * field.width + i] = {
          static_cast<float>(i) * field.cell_x, field.at(i, j), static_cast<float>(j) * field.cell_z};
    }
  });
  return points;
}

Heightfield interpolate_heights(std::span<const glm::vec3> points, const BisectionTree& tree,
                                Progress& progress) {
  const PlanExtent extent = plan_extent(points);
  const glm::vec2 size = extent.high - extent.low;
  if (!(size.x > 0 && size.y > 0)) {
    throw usage_error("the height points lie in one line", "", "give points that span an area");
  }
  const std::uint64_t along = static_cast<std::uint64_t>(tree.side()) + 1;
  require_memory(along * along * sizeof(float) + points.size() * NearestThree::kBytesPerPoint,
                 fmt::format("a grid of {}² heights", along), "choose a smaller depth");
  const NearestThree nearest(points);
  Heightfield field;
  field.width = field.depth = tree.side() + 1;
  field.cell_x = size.x / static_cast<float>(tree.side());
  field.cell_z = size.y / static_cast<float>(tree.side());
  field.heights.resize(static_cast<std::size_t>(field.width) * field.width);
  progress.begin("interpolating heights", static_cast<std::uint64_t>(field.depth));
  tbb::parallel_for(0, field.depth, [&](int j) {
    // The last row and column lie exactly on the border, where there may be a point.
    const float z = j == tree.side() ? extent.high.y : extent.low.y + static_cast<float>(j) * field.cell_z;
    for (int i = 0; i < field.width; ++i) {
      const float x = i == tree.side() ? extent.high.x : extent.low.x + static_cast<float>(i) * field.cell_x;
      field.at(i, j) = nearest.height(x, z);
    }
    progress.advance();
  });
  progress.end();
  return field;
}

}  // namespace terrabench
