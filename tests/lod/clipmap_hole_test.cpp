// The hole in a clipmap's finest level: exact in plan, at any height of the eye, and bounded by the window.
#include <gtest/gtest.h>

#include <cmath>

#include "lod/clipmap/clipmap.h"
#include "terrain/error.h"
#include "tests/lod/hybrid_ground.h"

namespace terrabench::test {
namespace {

// A hole takes out its cells and nothing else, wherever it lies under the eye.
TEST(ClipmapHole, TakesOutItsCells) {
  const Heightfield field = random_ground(180, 150, 7, 0, 10, 2, 3);
  Clipmap clipmap(heights_in_memory(field), 63);
  for (const glm::ivec2 at :
       {glm::ivec2(90, 70), glm::ivec2(91, 71), glm::ivec2(20, 140), glm::ivec2(0, 0)}) {
    const View view = everything_from(static_cast<float>(at.x) * 2, static_cast<float>(at.y) * 3);
    for (const int reach : {1, 7, 20}) {
      const glm::ivec2 low = glm::max(at - reach, 0), high = glm::min(at + reach + 1, glm::ivec2(179, 149));
      clipmap.set_hole(low, high);
      const Frame& frame = clipmap.update(view);
      const double hole = 6.0 * (high.x - low.x) * (high.y - low.y);
      EXPECT_NEAR(plan_area(frame), plan_area(field) - hole, 1e-3);
      // Inside the ground, the open edges are sides of the hole's cells, at the samples' heights.
      for (const auto& edge : unpaired_edges(frame)) {
        if (on_border(field, edge[0]) && on_border(field, edge[1])) continue;
        for (const glm::vec3& p : edge) {
          const glm::ivec2 sample(std::lround(p.x / 2), std::lround(p.z / 3));
          EXPECT_EQ(glm::clamp(sample, low, high), sample);
          EXPECT_EQ(p.y, field.at(sample.x, sample.y));
        }
        EXPECT_TRUE((edge[0].x == edge[1].x && std::abs(edge[0].z - edge[1].z) == 3) ||
                    (edge[0].z == edge[1].z && std::abs(edge[0].x - edge[1].x) == 2));
      }
      clipmap.set_hole({}, {});
      EXPECT_EQ(openings_inside(field, clipmap.update(view)), 0U);
    }
  }
}

TEST(ClipmapHole, MustFitTheFinestWindowAndTheGround) {
  const Heightfield field = random_ground(300, 300, 7, 0, 10, 2, 3);
  Clipmap clipmap(heights_in_memory(field), 63);
  const View view = everything_from(300, 450);
  const auto refused = [&](glm::ivec2 low, glm::ivec2 high) {
    clipmap.set_hole(low, high);
    try {
      clipmap.update(view);
    } catch (const Error& error) {
      return error.code() == ExitCode::kUsage;
    }
    return false;
  };
  const int reach = Clipmap::reach_of(clipmap.window());
  EXPECT_FALSE(refused({140, 140}, {150 + reach, 160}));
  EXPECT_TRUE(refused({140, 140}, {151 + reach, 160}));
  EXPECT_TRUE(refused({140, 140}, {140, 160}));
  EXPECT_TRUE(refused({-1, 140}, {160, 160}));
  EXPECT_FALSE(refused({}, {}));
  EXPECT_GE(Clipmap::reach_of(Clipmap::window_of(100)), 100);
  EXPECT_LT(Clipmap::reach_of(Clipmap::window_of(100) - 4), 100);
}

}  // namespace
}  // namespace terrabench::test
