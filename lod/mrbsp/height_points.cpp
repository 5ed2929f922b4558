#include "lod/mrbsp/height_points.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

#include "lod/lod.h"
#include "terrain/error.h"
#include "terrain/memory.h"

namespace terrabench {
namespace {

constexpr float kFar = std::numeric_limits<float>::infinity();

// The three nearest so far, nearest first.
struct Three {
  std::array<float, 3> distance{kFar, kFar, kFar};  // squared
  std::array<std::uint32_t, 3> order{};             // of equally near points the first given wins
  std::array<glm::vec3, 3> point{};
  int count = 0;

  void offer(float d, std::uint32_t which, const glm::vec3& p) {
    if (count == 3 && !before(d, which, 2)) return;
    int at = count < 3 ? count++ : 2;
    for (; at > 0 && before(d, which, at - 1); --at) {
      distance[at] = distance[at - 1];
      order[at] = order[at - 1];
      point[at] = point[at - 1];
    }
    distance[at] = d;
    order[at] = which;
    point[at] = p;
  }
  bool before(float d, std::uint32_t which, int at) const {
    return d < distance[at] || (d == distance[at] && which < order[at]);
  }
};

glm::vec2 plan(const glm::vec3& p) { return {p.x, p.z}; }
float cross(glm::vec2 a, glm::vec2 b) { return a.x * b.y - a.y * b.x; }

// The point of segment ab nearest to `at`: its height, and how far off it is.
struct Nearest {
  float height, distance;
};
Nearest on_segment(const glm::vec3& a, const glm::vec3& b, glm::vec2 at) {
  const glm::vec2 along = plan(b) - plan(a), to = at - plan(a);
  const float length = glm::dot(along, along);
  const float t = length > 0 ? glm::clamp(glm::dot(to, along) / length, 0.0F, 1.0F) : 0;
  const glm::vec2 off = to - t * along;
  return {a.y * (1 - t) + b.y * t, glm::dot(off, off)};
}

float interpolate(const Three& near, glm::vec2 at) {
  const auto& [a, b, c] = near.point;
  if (near.count == 1 || near.distance[0] == 0) return a.y;
  if (near.count == 2) return on_segment(a, b, at).height;
  const float area = cross(plan(b) - plan(a), plan(c) - plan(a));
  const float u = cross(plan(b) - at, plan(c) - at), v = cross(plan(c) - at, plan(a) - at);
  const float w = cross(plan(a) - at, plan(b) - at);
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

struct Extent {
  glm::vec2 low{kFar}, high{-kFar};
};
Extent extent_of(std::span<const glm::vec3> points) {
  if (points.empty() || points.size() > std::size_t{1} << 31) {
    throw usage_error("heights cannot be interpolated from so few or so many points", "",
                      "give at least one and at most 2^31");
  }
  Extent extent;
  for (const glm::vec3& p : points) {
    extent.low = glm::min(extent.low, plan(p));
    extent.high = glm::max(extent.high, plan(p));
  }
  return extent;
}

}  // namespace

NearestThree::NearestThree(std::span<const glm::vec3> points) {
  const Extent extent = extent_of(points);
  low_ = extent.low;
  const glm::vec2 size = extent.high - extent.low;
  // Points in one line or place make the buckets of a line or one bucket.
  constexpr float kPointsABucket = 2, kMostAlong = 1 << 14;
  const float count = static_cast<float>(points.size());
  const float longest = std::max(size.x, size.y);
  side_ = std::max(std::sqrt(size.x * size.y * kPointsABucket / count), longest * kPointsABucket / count);
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
  Three near;
  const auto search = [&](int i0, int i1, int j) {
    if (j < 0 || j >= rows_) return;
    i0 = std::max(i0, 0);
    i1 = std::min(i1, columns_ - 1);
    if (i0 > i1) return;
    const std::size_t row = static_cast<std::size_t>(j) * columns_;
    for (std::uint32_t k = first_[row + i0]; k < first_[row + i1 + 1]; ++k) {
      const glm::vec2 to = plan(points_[k]) - glm::vec2(x, z);
      near.offer(glm::dot(to, to), order_[k], points_[k]);
    }
  };
  search(bx - 1, bx + 1, bz - 1);
  search(bx - 1, bx + 1, bz);
  search(bx - 1, bx + 1, bz + 1);
  // What is beyond ring r of buckets is at least this far, for a place inside the ring's middle bucket; a
  // place outside all buckets is farther still from all of them.
  const glm::vec2 in_bucket((x - low_.x) - static_cast<float>(bx) * side_,
                            (z - low_.y) - static_cast<float>(bz) * side_);
  const float margin =
      std::max(0.0F, std::min({in_bucket.x, in_bucket.y, side_ - in_bucket.x, side_ - in_bucket.y}));
  const int last = std::max(columns_, rows_);
  for (int r = 1; r < last; ++r) {
    // A hair less, so that rounding cannot hide a point that is as near as the third.
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
  return interpolate(near, {x, z});
}

std::vector<glm::vec3> height_points(const Heightfield& field) {
  require_memory(field.heights.size() * (sizeof(glm::vec3) + NearestThree::kBytesAPoint), "height points");
  std::vector<glm::vec3> points(field.heights.size());
  tbb::parallel_for(0, field.depth, [&](int j) {
    for (int i = 0; i < field.width; ++i) {
      points[static_cast<std::size_t>(j) * field.width + i] = {
          static_cast<float>(i) * field.cell_x, field.at(i, j), static_cast<float>(j) * field.cell_z};
    }
  });
  return points;
}

Heightfield interpolate_lattice(std::span<const glm::vec3> points, const BisectionTree& tree,
                                Progress& progress) {
  const Extent extent = extent_of(points);
  const glm::vec2 size = extent.high - extent.low;
  if (!(size.x > 0 && size.y > 0)) {
    throw usage_error("the height points span no area", "", "give points that do not lie in one line");
  }
  const std::uint64_t along = static_cast<std::uint64_t>(tree.side()) + 1;
  require_memory(along * along * sizeof(float) + points.size() * NearestThree::kBytesAPoint,
                 fmt::format("a lattice of {}² heights", along), "choose a smaller depth");
  const NearestThree nearest(points);
  Heightfield field;
  field.width = field.depth = tree.side() + 1;
  field.cell_x = size.x / static_cast<float>(tree.side());
  field.cell_z = size.y / static_cast<float>(tree.side());
  field.heights.resize(static_cast<std::size_t>(field.width) * field.width);
  progress.begin("interpolating heights", static_cast<std::uint64_t>(field.depth));
  tbb::parallel_for(0, field.depth, [&](int j) {
    // The last ones exactly at the border, where a point may stand.
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

namespace {

// The printed recursion. The subsets of the triangles on the way down lie behind each other in one array.
class SubsetBuilder {
 public:
  SubsetBuilder(std::span<const glm::vec3> points, const BisectionTree& tree, bool cuts_shared)
      : points_(points), tree_(tree), cuts_shared_(cuts_shared), extent_(extent_of(points)) {
    step_ = (extent_.high - extent_.low) / static_cast<float>(tree.side());
  }

  SubsetTriangles build() {
    result_.corners.reserve(3 * tree_.triangles());
    stack_.resize(points_.size());
    for (std::size_t i = 0; i < stack_.size(); ++i) stack_[i] = static_cast<std::uint32_t>(i);
    const auto roots = tree_.roots();
    for (int which = 0; which < 2; ++which) {
      const PlanTriangle& t = roots[which];
      // The square lies at sea level: what a half without points falls back to.
      hand_down({0, points_.size()}, {t.left, t.right, t.apex}, which == 0, [&](Subset half) {
        descend(t, 1, half, {0, 0, 0});
      });
    }
    return std::move(result_);
  }

 private:
  using Heights = std::array<float, 3>;
  struct Subset {
    std::size_t begin, end;
  };
  struct Cut {
    glm::ivec2 from, to, on_side;
  };

  glm::vec2 place(glm::ivec2 at) const { return extent_.low + glm::vec2(at) * step_; }

  // Calls `body` with the part of a subset on one side of a cut.
  template <class Body>
  void hand_down(Subset subset, const Cut& cut, bool takes_cut, const Body& body) {
    const glm::vec2 from = place(cut.from), along = place(cut.to) - from;
    const float this_side = cross(along, place(cut.on_side) - from);
    const std::size_t begin = stack_.size();
    for (std::size_t k = subset.begin; k < subset.end; ++k) {
      const std::uint32_t i = stack_[k];
      const float side = cross(along, plan(points_[i]) - from) * this_side;
      if (side > 0 || (side == 0 && (takes_cut || cuts_shared_))) stack_.push_back(i);
    }
    body({begin, stack_.size()});
    stack_.resize(begin);
  }

  Heights corner_heights(const PlanTriangle& t, Subset subset, const Heights& fallback) const {
    if (subset.begin == subset.end) return fallback;
    Heights heights;
    const std::array<glm::ivec2, 3> corners{t.apex, t.left, t.right};
    for (int c = 0; c < 3; ++c) {
      const glm::vec2 at = place(corners[c]);
      Three near;
      for (std::size_t k = subset.begin; k < subset.end; ++k) {
        const std::uint32_t i = stack_[k];
        const glm::vec2 to = plan(points_[i]) - at;
        near.offer(glm::dot(to, to), i, points_[i]);
      }
      heights[c] = interpolate(near, at);
    }
    return heights;
  }

  void descend(const PlanTriangle& t, int depth, Subset subset, const Heights& fallback) {
    const Heights heights = corner_heights(t, subset, fallback);
    if (depth == tree_.depth()) {
      result_.starved += subset.end - subset.begin < 3;
      const std::array<glm::ivec2, 3> corners{t.apex, t.left, t.right};
      for (int c = 0; c < 3; ++c) {
        const glm::vec2 at = place(corners[c]);
        result_.corners.push_back({at.x, heights[c], at.y});
      }
      return;
    }
    const glm::ivec2 foot = (t.left + t.right) / 2;
    const float middle = 0.5F * (heights[1] + heights[2]);
    hand_down(subset, {t.apex, foot, t.left}, true, [&](Subset half) {
      descend(BisectionTree::child(t, 0), depth + 1, half, {middle, heights[0], heights[1]});
    });
    hand_down(subset, {t.apex, foot, t.right}, false, [&](Subset half) {
      descend(BisectionTree::child(t, 1), depth + 1, half, {middle, heights[2], heights[0]});
    });
  }

  std::span<const glm::vec3> points_;
  const BisectionTree& tree_;
  bool cuts_shared_;
  Extent extent_;
  glm::vec2 step_{1};
  std::vector<std::uint32_t> stack_;
  SubsetTriangles result_;
};

}  // namespace

SubsetTriangles interpolate_subsets(std::span<const glm::vec3> points, const BisectionTree& tree,
                                    bool cuts_shared) {
  return SubsetBuilder(points, tree, cuts_shared).build();
}

VertexGaps vertex_gaps(const SubsetTriangles& triangles) {
  std::vector<glm::vec3> corners = triangles.corners;
  std::sort(corners.begin(), corners.end(), [](const glm::vec3& a, const glm::vec3& b) {
    return std::array{a.x, a.z, a.y} < std::array{b.x, b.z, b.y};
  });
  VertexGaps gaps;
  double sum = 0;
  for (std::size_t begin = 0, end = 0; begin < corners.size(); begin = end) {
    while (end < corners.size() && plan(corners[end]) == plan(corners[begin])) ++end;
    const double gap = double{corners[end - 1].y} - corners[begin].y;
    ++gaps.vertices;
    gaps.torn += gap > 0;
    sum += gap;
    gaps.largest = std::max(gaps.largest, gap);
  }
  gaps.mean = gaps.vertices > 0 ? sum / static_cast<double>(gaps.vertices) : 0;
  return gaps;
}

}  // namespace terrabench
