// Terrains to drill, and slow, literal implementations of the paper to compare with.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "representations/drill/extract.h"
#include "terrain/heightfield.h"
#include "tests/terrain/ground.h"

namespace terrabench::test {

inline Drills drill(const Heightfield& field, const DrillOptions& options) {
  return extract_drills(field, route_flow(field), options);
}

// Eq. 1 word for word, in any order.
inline std::vector<float> drilled_naively(const Drills& drills, unsigned seed) {
  std::vector<std::size_t> order(drills.count());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::shuffle(order.begin(), order.end(), std::mt19937(seed));
  std::vector<float> t(drills.pixels(), drills.plateau);
  for (const std::size_t d : order) {
    const int x = static_cast<int>(drills.pixel[d]) % drills.width,
              z = static_cast<int>(drills.pixel[d]) / drills.width;
    const int k = drills.influence_of(d);
    for (int j = -k; j <= k; ++j) {
      for (int i = -k; i <= k; ++i) {
        if (x + i < 0 || z + j < 0 || x + i >= drills.width || z + j >= drills.depth) continue;
        const float r = std::sqrt(static_cast<float>(i * i + j * j));
        float& at = t[static_cast<std::size_t>(z + j) * drills.width + (x + i)];
        at = std::min(at, drills.elevation[d] + r * (drills.slope[d] + drills.curvature[d] * r));
      }
    }
  }
  for (const HoleRun& hole : drills.holes) {
    for (std::uint32_t i = 0; i < hole.count; ++i) t[hole.first + i] = Heightfield::kNoData;
  }
  return t;
}

// Equal to the bit, holes included.
inline bool same_heights(const std::vector<float>& a, const std::vector<float>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](float p, float q) { return p == q || (std::isnan(p) && std::isnan(q)); });
}

inline bool same_drills(const Drills& a, const Drills& b) {
  return a.width == b.width && a.depth == b.depth && a.cell_x == b.cell_x && a.cell_z == b.cell_z &&
         a.plateau == b.plateau && a.w == b.w && a.k == b.k && a.quantum == b.quantum &&
         a.interpolated == b.interpolated && a.pixel == b.pixel && a.direction == b.direction &&
         a.elevation == b.elevation && a.slope == b.slope && a.curvature == b.curvature &&
         a.influence == b.influence && a.holes == b.holes;
}

}  // namespace terrabench::test
