// Eq. 1, what no drill touches, pits, and a k for every drill.
#include "representations/drill/extract.h"
#include "representations/drill/pits.h"
#include "representations/drill/regenerate.h"
#include "tests/representations/drill_ground.h"

namespace terrabench::test {
namespace {

DrillOptions options_for(std::uint32_t tau, int w, int k) {
  DrillOptions options;
  options.tau = tau;
  options.w = w;
  options.k = k;
  return options;
}

double squared_error(const Heightfield& a, const Heightfield& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.heights.size(); ++i) {
    if (!std::isnan(a.heights[i])) sum += std::pow(static_cast<double>(a.heights[i]) - b.heights[i], 2);
  }
  return sum;
}

TEST(Regeneration, IsEquationOneInAnyOrder) {
  // Windows smaller and larger than vectors, tiles and the terrain.
  for (const int k : {0, 1, 3, 7, 20, 64, 255}) {
    const Heightfield field = hills(83, 61, static_cast<unsigned>(k), false, k % 2 == 0 ? 5U : 0U);
    for (const DrillFit fit : {DrillFit::kMonotone, DrillFit::kPrinted, DrillFit::kVertex}) {
      DrillOptions options = options_for(30, 6, k);
      options.fit = fit;
      const Drills drills = drill(field, options);
      ASSERT_GT(drills.count(), 20U);
      const Heightfield got = regenerate(drills);
      EXPECT_TRUE(same_heights(got.heights, drilled_naively(drills, 1))) << k;
      EXPECT_TRUE(same_heights(got.heights, drilled_naively(drills, 2))) << k;
      EXPECT_EQ(got.cell_x, field.cell_x);
    }
  }
}

TEST(Regeneration, OfManyTilesWithAKForEachDrill) {
  const Heightfield field = hills(2100, 120, 3);
  Drills drills = drill(field, options_for(60, 3, 25));
  std::mt19937 random(1);
  for (std::size_t i = 0; i < drills.count(); ++i)
    drills.influence.push_back(static_cast<std::uint8_t>(random() % 26));
  EXPECT_TRUE(same_heights(regenerate(drills).heights, drilled_naively(drills, 3)));
}

TEST(Regeneration, NeverRisesAndKeepsChannelsUnlessDrilledDeeper) {
  const Heightfield field = hills(60, 60, 9);
  const Drills drills = drill(field, options_for(10, 5, 9));
  const Heightfield got = regenerate(drills);
  for (const float h : got.heights) EXPECT_LE(h, drills.plateau);
  std::size_t kept = 0;
  for (std::size_t i = 0; i < drills.count(); ++i) {
    EXPECT_LE(got.heights[drills.pixel[i]], drills.elevation[i]);
    kept += got.heights[drills.pixel[i]] == drills.elevation[i] ? 1 : 0;
  }
  EXPECT_GT(kept, drills.count() / 2);
  Drills fewer = drills;
  for (auto* list : {&fewer.elevation, &fewer.slope, &fewer.curvature}) list->resize(list->size() / 2);
  fewer.pixel.resize(fewer.elevation.size());
  fewer.direction.resize(fewer.elevation.size());
  const Heightfield before = regenerate(fewer);
  for (std::size_t i = 0; i < got.heights.size(); ++i) EXPECT_LE(got.heights[i], before.heights[i]);
}

TEST(Regeneration, WithoutDrillsIsThePlateau) {
  const Drills drills = drill(hills(30, 20, 1, false, 10), options_for(4000000, 5, 5));
  const Heightfield got = regenerate(drills);
  std::size_t holes = 0;
  for (const float h : got.heights) {
    if (std::isnan(h)) {
      ++holes;
    } else {
      EXPECT_EQ(h, drills.plateau);
    }
  }
  EXPECT_GT(holes, 0U);
  EXPECT_EQ(count_untouched(drills, got.heights), 600 - holes);
}

TEST(Regeneration, IsTheSameForAnyThreadsAndInstructionSet) {
  const Drills drills = drill(hills(130, 170, 2), options_for(15, 6, 11));
  const Heightfield many = regenerate(drills);
  with_any_threads_and_targets([&] { EXPECT_EQ(regenerate(drills).heights, many.heights); });
}

TEST(Untouched, PixelsAreCountedAndDrawnFromTheirSurroundings) {
  const Heightfield field = hills(90, 90, 6, false, 1);
  Drills drills = drill(field, options_for(80, 8, 4));
  const Heightfield raw = regenerate(drills);
  std::size_t plateau = 0;
  for (const float h : raw.heights) plateau += h == drills.plateau ? 1 : 0;
  ASSERT_GT(plateau, 100U);
  EXPECT_EQ(count_untouched(drills, raw.heights), plateau);
  drills.interpolated = true;
  const Heightfield drawn = regenerate(drills);
  for (std::size_t i = 0; i < raw.heights.size(); ++i) {
    EXPECT_EQ(std::isnan(drawn.heights[i]), std::isnan(raw.heights[i]));
    if (is_touched(raw.heights[i], drills)) {
      EXPECT_EQ(drawn.heights[i], raw.heights[i]);
    }
  }
  EXPECT_LT(squared_error(field, drawn), 0.5 * squared_error(field, raw));
}

TEST(Untouched, NothingToDrawFromLeavesThePlateau) {
  Drills drills = drill(hills(12, 12, 1), options_for(100000, 3, 3));
  drills.interpolated = true;
  for (const float h : regenerate(drills).heights) EXPECT_EQ(h, drills.plateau);
}

TEST(Influence, OfItsOwnForEachDrillLowersTheError) {
  for (const unsigned seed : {1U, 2U, 3U}) {
    const Heightfield field = hills(120, 100, seed);
    DrillOptions options = options_for(15, 8, 25);
    const Heightfield uniform = regenerate(drill(field, options));
    options.adaptive_k = true;
    const Drills drills = drill(field, options);
    ASSERT_EQ(drills.influence.size(), drills.count());
    EXPECT_LE(*std::max_element(drills.influence.begin(), drills.influence.end()), 25);
    EXPECT_GE(*std::min_element(drills.influence.begin(), drills.influence.end()), 2);
    EXPECT_LT(squared_error(field, regenerate(drills)), squared_error(field, uniform));
  }
}

TEST(Influence, SmallerThanTheLeastCandidateIsKept) {
  const Heightfield field = hills(40, 40, 1);
  for (const int k : {0, 1, 2}) {
    DrillOptions options = options_for(15, 4, k);
    options.adaptive_k = true;
    const Drills drills = drill(field, options);
    for (const std::uint8_t own : drills.influence) EXPECT_EQ(own, k);
  }
}

// The same by brute force: a pixel is drained when some path that never rises leads out.
std::size_t pits_naively(const Heightfield& field) {
  std::vector<bool> drained(field.heights.size());
  for (bool changed = true; changed;) {
    changed = false;
    for (int j = 0; j < field.depth; ++j) {
      for (int i = 0; i < field.width; ++i) {
        const std::size_t at = static_cast<std::size_t>(j) * field.width + i;
        if (drained[at] || std::isnan(field.heights[at])) continue;
        for (const FlowStep step : kFlowSteps) {
          const int x = i + step.x, z = j + step.z;
          const bool outside = x < 0 || z < 0 || x >= field.width || z >= field.depth;
          const float there = outside ? Heightfield::kNoData : field.at(x, z);
          const bool drains =
              std::isnan(there) || there < field.heights[at] ||
              (there == field.heights[at] && drained[static_cast<std::size_t>(z) * field.width + x]);
          if (drains && !drained[at]) drained[at] = changed = true;
        }
      }
    }
  }
  // Lower neighbours count as drains even when they lie in a pit themselves, so that only the bottoms remain.
  std::size_t pits = 0;
  std::vector<std::size_t> stack;
  for (std::size_t start = 0; start < drained.size(); ++start) {
    if (drained[start] || std::isnan(field.heights[start])) continue;
    ++pits;
    drained[start] = true;
    for (stack = {start}; !stack.empty();) {
      const std::size_t at = stack.back();
      stack.pop_back();
      const int i = static_cast<int>(at) % field.width, j = static_cast<int>(at) / field.width;
      for (const FlowStep step : kFlowSteps) {
        const std::size_t next = static_cast<std::size_t>(j + step.z) * field.width + (i + step.x);
        if (drained[next] || field.heights[next] != field.heights[at]) continue;
        drained[next] = true;
        stack.push_back(next);
      }
    }
  }
  return pits;
}

TEST(Pits, AreFlatsWithoutAWayDown) {
  std::mt19937 random(3);
  for (int round = 0; round < 40; ++round) {
    Heightfield field{4 + static_cast<int>(random() % 20), 4 + static_cast<int>(random() % 20), 1, 1, {}, {}};
    const unsigned levels = 2 + random() % 6;
    for (int i = 0; i < field.width * field.depth; ++i) {
      field.heights.push_back(random() % 30 == 0 ? Heightfield::kNoData
                                                 : static_cast<float>(random() % levels));
    }
    EXPECT_EQ(count_pits(field), pits_naively(field));
  }
}

TEST(Pits, OfKnownTerrains) {
  EXPECT_EQ(count_pits({3, 3, 1, 1, {2, 2, 2, 2, 1, 2, 2, 2, 2}, {}}), 1U);
  EXPECT_EQ(count_pits({3, 3, 1, 1, {2, 2, 2, 2, 3, 2, 2, 2, 2}, {}}), 0U);
  EXPECT_EQ(count_pits({1, 1, 1, 1, {5}, {}}), 0U);
  EXPECT_EQ(count_pits({4, 3, 1, 1, {2, 2, 2, 2, 2, 1, 1, 2, 2, 2, 2, 2}, {}}), 1U);  // two pixels wide
}

TEST(Pits, MonotoneProfilesLeaveNone) {
  for (const unsigned seed : {1U, 2U, 3U, 4U}) {
    const Heightfield field = hills(110, 90, seed, seed % 2 == 0, seed == 3 ? 2U : 0U);
    ASSERT_GT(count_pits(field), 10U);
    for (const bool adaptive : {false, true}) {
      DrillOptions options = options_for(12, 7, 9);
      options.adaptive_k = adaptive;
      EXPECT_GT(count_pits(regenerate(drill(field, options))), 0U);
      options.monotone_profiles = true;
      EXPECT_EQ(count_pits(regenerate(drill(field, options))), 0U);
    }
  }
}

}  // namespace
}  // namespace terrabench::test
