#include "representations/procedural_mesh/triangle_columns.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>
#include <numeric>

namespace terrabench {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr int kMostBins = 1 << 14;                // along one axis
constexpr std::uint64_t kEntriesPerTriangle = 4;  // more, and the bins are too small for the triangles

float just_below(float at) { return std::nextafter(at, -kInfinity); }

// Whether an end at `edge` lies before the line at `at`, which counts as moved up, or down if kBefore.
template <bool kBefore>
bool passed(float edge, float at) {
  return kBefore ? edge < at : edge <= at;
}

// The height of the triangle's plane above (x, z), exact at the vertices.
float height_at(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, double x, double z) {
  const double bx = b.x - a.x, bz = b.z - a.z, cx = c.x - a.x, cz = c.z - a.z, px = x - a.x, pz = z - a.z;
  const double area = bx * cz - bz * cx;
  const double of_b = (px * cz - pz * cx) / area, of_c = (bx * pz - bz * px) / area;
  const double y = (1 - of_b - of_c) * a.y + of_b * b.y + of_c * c.y;
  const auto [low, high] = std::minmax({a.y, b.y, c.y});
  // A sliver's area may round to 0.
  return static_cast<float>(y > low ? std::min(y, high) : low);
}

// How often the triangle's outline, seen from above, runs around (x, z): -1 for one that looks up, 1 for one
// that looks down, otherwise 0.
template <bool kBeforeX, bool kBeforeZ>
int turns(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c, float x, float z) {
  const bool pa = passed<kBeforeZ>(a.z, z), pb = passed<kBeforeZ>(b.z, z), pc = passed<kBeforeZ>(c.z, z);
  if (pa == pb && pb == pc) return 0;
  const auto crossed = [&](const glm::vec3& u, const glm::vec3& v, bool pu, bool pv) {
    if (pu == pv) return 0;
    const glm::dvec3 low = pu ? u : v, high = pu ? v : u;
    const double side = (high.x - low.x) * (z - low.z) - (x - low.x) * (high.z - low.z);
    if (kBeforeX ? side < 0 : side <= 0) return 0;  // the edge lies to the left
    return pu ? 1 : -1;
  };
  return crossed(a, b, pa, pb) + crossed(b, c, pb, pc) + crossed(c, a, pc, pa);
}

}  // namespace

void TriangleColumns::Axis::divide(int into) {
  const double size = static_cast<double>(high) - low;
  bins = size > 0 ? into : 1;
  per_metre = size > 0 ? bins / size : 0;
}

TriangleColumns::TriangleColumns(std::vector<glm::vec3> positions, std::vector<Triangle> triangles)
    : positions_(std::move(positions)), triangles_(std::move(triangles)) {
  positions_.shrink_to_fit();
  triangles_.shrink_to_fit();
  if (triangles_.empty()) return;
  choose_bins();
  fill_bins();
}

// Half as many bins as triangles, which for a grid of quadrilaterals is one each, and fewer while long
// triangles lie in too many bins.
void TriangleColumns::choose_bins() {
  glm::vec3 low(kInfinity), high(-kInfinity);
  for (const glm::vec3& p : positions_) {
    low = {std::min(low.x, p.x), 0, std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), 0, std::max(high.z, p.z)};
  }
  x_.low = low.x;
  x_.high = high.x;
  z_.low = low.z;
  z_.high = high.z;
  const double wanted = std::max(1.0, static_cast<double>(triangles_.size()) / 2);
  const double size_x = static_cast<double>(high.x) - low.x, size_z = static_cast<double>(high.z) - low.z;
  const double along_x = size_z > 0 ? std::sqrt(wanted * size_x / size_z) : wanted;
  double bins_x = std::clamp(std::round(along_x), 1.0, std::min(wanted, double{kMostBins}));
  double bins_z = std::clamp(std::round(wanted / bins_x), 1.0, std::min(wanted, double{kMostBins}));
  x_.divide(static_cast<int>(bins_x));
  z_.divide(static_cast<int>(bins_z));
  while (entries() > kEntriesPerTriangle * triangles_.size() + 64 && (x_.bins > 1 || z_.bins > 1)) {
    x_.divide(std::max(1, x_.bins / 2));
    z_.divide(std::max(1, z_.bins / 2));
  }
}

// A triangle that ends exactly where a bin begins is left out of that bin: a line there counts as moved on.
TriangleColumns::Cover TriangleColumns::cover(const Triangle& t) const {
  const glm::vec3 &a = positions_[t.x], &b = positions_[t.y], &c = positions_[t.z];
  const float x0 = std::min({a.x, b.x, c.x}), x1 = std::max({a.x, b.x, c.x});
  const float z0 = std::min({a.z, b.z, c.z}), z1 = std::max({a.z, b.z, c.z});
  if (x0 == x1 || z0 == z1) return {};
  return {x_.bin(x0), x_.bin(just_below(x1)), z_.bin(z0), z_.bin(just_below(z1))};
}

std::uint64_t TriangleColumns::entries() const {
  return tbb::parallel_reduce(
      tbb::blocked_range<std::size_t>(0, triangles_.size(), 4096), std::uint64_t{0},
      [&](const auto& range, std::uint64_t sum) {
        for (std::size_t t = range.begin(); t < range.end(); ++t) sum += cover(triangles_[t]).bins();
        return sum;
      },
      std::plus<>());
}

void TriangleColumns::fill_bins() {
  const auto each = [&](const auto& action) {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, triangles_.size(), 4096), [&](const auto& range) {
      for (std::size_t t = range.begin(); t < range.end(); ++t) {
        const Cover c = cover(triangles_[t]);
        for (int j = c.z0; j <= c.z1; ++j) {
          for (int i = c.x0; i <= c.x1; ++i) {
            action(std::atomic_ref(first_[static_cast<std::size_t>(j) * x_.bins + i]), t);
          }
        }
      }
    });
  };
  first_.assign(static_cast<std::size_t>(x_.bins) * z_.bins + 1, 0);
  each([](auto count, std::size_t) { count.fetch_add(1, std::memory_order_relaxed); });
  std::inclusive_scan(first_.begin(), first_.end(), first_.begin());
  inside_.resize(first_.back());
  // From the bin's end downward, so that each entry of first_ ends as its bin's begin. The order within a bin
  // depends on the threads; crossings() sorts what it finds.
  each([&](auto end, std::size_t t) {
    inside_[end.fetch_sub(1, std::memory_order_relaxed) - 1] = static_cast<std::uint32_t>(t);
  });
}

template <bool kBeforeX, bool kBeforeZ>
void TriangleColumns::collect(float x, float z, std::vector<Crossing>& out) const {
  const int i = x_.bin(kBeforeX ? just_below(x) : x), j = z_.bin(kBeforeZ ? just_below(z) : z);
  const std::size_t bin = static_cast<std::size_t>(j) * x_.bins + i;
  for (std::uint32_t at = first_[bin]; at < first_[bin + 1]; ++at) {
    const Triangle& t = triangles_[inside_[at]];
    const glm::vec3 &a = positions_[t.x], &b = positions_[t.y], &c = positions_[t.z];
    const int weight = turns<kBeforeX, kBeforeZ>(a, b, c, x, z);
    if (weight != 0) out.push_back({height_at(a, b, c, x, z), weight});
  }
}

void TriangleColumns::crossings(float x, float z, std::vector<Crossing>& out) const {
  out.clear();
  if (triangles_.empty() || !x_.covers(x) || !z_.covers(z)) return;
  collect<false, false>(x, z, out);
  if (out.empty()) collect<true, false>(x, z, out);
  if (out.empty()) collect<false, true>(x, z, out);
  if (out.empty()) collect<true, true>(x, z, out);
  if (out.size() < 2) return;
  std::sort(out.begin(), out.end(), [](const Crossing& a, const Crossing& b) {
    return a.y != b.y ? a.y < b.y : a.weight > b.weight;
  });
}

void TriangleColumns::prefetch(std::span<const float> x, std::span<const float> z) const {
  constexpr std::uint32_t kMostTriangles = 4;  // of one line; the processor follows longer lists by itself
  if (triangles_.empty()) return;
  std::array<std::size_t, kTogether> bins;
  const std::size_t lines = std::min(x.size(), kTogether);
  for (std::size_t l = 0; l < lines; ++l) {
    // Lines outside read bin 0.
    const bool inside = x_.covers(x[l]) && z_.covers(z[l]);
    bins[l] = inside ? static_cast<std::size_t>(z_.bin(z[l])) * x_.bins + x_.bin(x[l]) : 0;
    __builtin_prefetch(&first_[bins[l]]);
  }
  const auto each = [&](const auto& action) {
    for (std::size_t l = 0; l < lines; ++l) {
      const std::uint32_t begin = first_[bins[l]], end = first_[bins[l] + 1];
      for (std::uint32_t at = begin; at < std::min(end, begin + kMostTriangles); ++at) action(at);
    }
  };
  each([&](std::uint32_t at) { __builtin_prefetch(&inside_[at]); });
  each([&](std::uint32_t at) { __builtin_prefetch(&triangles_[inside_[at]]); });
  each([&](std::uint32_t at) {
    const Triangle& t = triangles_[inside_[at]];
    for (int k = 0; k < 3; ++k) __builtin_prefetch(&positions_[t[k]]);
  });
}

Memory TriangleColumns::memory() const {
  Memory memory = payload_memory(positions_, triangles_);
  memory += index_memory(first_, inside_);
  return memory;
}

}  // namespace terrabench
