#include "lod/meters/coverage.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cstdint>
#include <vector>

#include "lod/meters/drawn_triangles.h"

namespace terrabench {
namespace {

constexpr int kBits = 64;  // samples per word

class Coverage {
 public:
  Coverage(int width, int depth)
      : width_(width),
        depth_(depth),
        words_((static_cast<std::size_t>(width) + kBits - 1) / kBits),
        bits_(words_ * static_cast<std::size_t>(depth), 0) {}

  // How many of the triangle's samples were covered before.
  std::size_t cover(const Corner* corners) {
    const bool turned = doubled_plan_area(corners) < 0;
    const Corner triangle[] = {corners[0], corners[turned ? 2 : 1], corners[turned ? 1 : 2]};
    const auto [first, last] = std::minmax({triangle[0].z, triangle[1].z, triangle[2].z});
    std::size_t again = 0;
    // The rule: a sample counts as displaced infinitesimally to the east and, by a smaller order, to the
    // south.
    for (int z = std::max(first, 0); z < std::min(last, depth_); ++z) {
      long long low = 0, high = width_ - 1;
      for (int e = 0; e < 3; ++e) {
        const Corner &p = triangle[e], &q = triangle[(e + 1) % 3];
        // Inside: (q.z - p.z)·(x - p.x) > (q.x - p.x)·(z - p.z).
        const long long slope = q.z - p.z, limit = static_cast<long long>(q.x - p.x) * (z - p.z);
        if (slope > 0) low = std::max(low, p.x - plan_triangle::floor_divide(-limit, slope));
        if (slope < 0) high = std::min(high, p.x - plan_triangle::floor_divide(limit, -slope) - 1);
        // Inside lies north of an edge that runs east, without its row, or south of one that runs west, with
        // its row.
        if (slope == 0 && (limit > 0 || (limit == 0 && q.x > p.x))) high = -1;
      }
      if (low <= high) again += cover_row(z, static_cast<int>(low), static_cast<int>(high));
    }
    return again;
  }

 private:
  std::size_t cover_row(int z, int low, int high) {
    std::size_t again = 0;
    for (int word = low / kBits; word <= high / kBits; ++word) {
      const int from = std::max(low - word * kBits, 0), to = std::min(high - word * kBits, kBits - 1);
      const std::uint64_t mask = (~std::uint64_t{0} >> (kBits - 1 - to)) & (~std::uint64_t{0} << from);
      const std::size_t at = static_cast<std::size_t>(z) * words_ + static_cast<std::size_t>(word);
      const std::uint64_t before =
          std::atomic_ref<std::uint64_t>(bits_[at]).fetch_or(mask, std::memory_order_relaxed);
      again += static_cast<std::size_t>(std::popcount(before & mask));
    }
    return again;
  }

  int width_, depth_;
  std::size_t words_;  // per row
  std::vector<std::uint64_t> bits_;
};

}  // namespace

std::size_t samples_covered_again(const Frame& frame, int width, int depth) {
  Coverage coverage(width, depth);
  std::atomic<std::size_t> again = 0;
  for_drawn_triangles(frame, [&](std::span<const Corner> corners) {
    std::size_t here = 0;
    for (std::size_t k = 0; k < corners.size(); k += 3) {
      if (doubled_plan_area(&corners[k]) != 0) here += coverage.cover(&corners[k]);
    }
    again.fetch_add(here, std::memory_order_relaxed);
  });
  return again;
}

}  // namespace terrabench
