#include "terrain/events/section.h"

#include <algorithm>

namespace terrabench::events {
namespace {

// A bulge is at least eight times as wide as high and at most half as wide as a side, so sixteen chords per
// side stay within a hundredth of its width.
constexpr int kChords = 16;

}  // namespace

void section_ranges(const Carving& carving, double u, double a, std::vector<SectionRange>& out) {
  out.clear();
  std::array<double, kMostCorners * kChords> crossings;
  std::size_t n = 0;
  const int chords = carving.roughness > 0 ? kChords : 1;
  for (std::size_t side = 0; side < carving.section.size(); ++side) {
    glm::dvec2 p = carving.wall(side, u, 0);
    for (int c = 1; c <= chords; ++c) {
      const glm::dvec2 q = carving.wall(side, u, static_cast<double>(c) / chords);
      if ((p.x <= a) != (q.x <= a)) crossings[n++] = p.y + (q.y - p.y) * (a - p.x) / (q.x - p.x);
      p = q;
    }
  }
  std::sort(crossings.begin(), crossings.begin() + n);
  for (std::size_t i = 0; i + 1 < n; i += 2) out.push_back({crossings[i], crossings[i + 1]});
}

SectionRange section_reach(const Carving& carving, double u) {
  SectionRange reach{HUGE_VAL, -HUGE_VAL};
  for (const glm::dvec2 corner : carving.section) {
    reach.low = std::min(reach.low, corner.x * carving.scale(u) - carving.roughness);
    reach.high = std::max(reach.high, corner.x * carving.scale(u) + carving.roughness);
  }
  return reach;
}

}  // namespace terrabench::events
