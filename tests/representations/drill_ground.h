// Terrains to drill, and slow, literal implementations of the paper to compare with.
#pragma once

#include <gtest/gtest.h>
#include <hwy/highway.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

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

// Calls check() with one and with five threads, and with every instruction set.
template <class Check>
void with_any_threads_and_targets(const Check& check) {
  for (const int threads : {1, 5}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                    static_cast<std::size_t>(threads));
    tbb::task_arena(threads).execute([&] { check(); });
  }
  const std::vector<std::int64_t> targets = hwy::SupportedAndGeneratedTargets();
  EXPECT_GT(targets.size(), 1U);
  for (const std::int64_t target : targets) {
    SCOPED_TRACE(hwy::TargetName(target));
    hwy::SetSupportedTargetsForTest(target);
    check();
  }
  hwy::SetSupportedTargetsForTest(0);
}

}  // namespace terrabench::test
