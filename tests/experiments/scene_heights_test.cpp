// Heights of ground with overhangs and cliffs, as landscapes draw them.
#include <gtest/gtest.h>

#include <cmath>

#include "experiments/scene.h"

namespace terrabench {
namespace {

// A cliff of 40 m that runs askew to the samples.
TerrainSource cliff() {
  TerrainSource source;
  source.name = "cliff";
  source.solid =
      Solid{{{0, 0, 0}, {80, 60, 80}}, "", [](const ColumnSamples& at, std::span<Material> out) {
              const float top = at.x + 0.36F * at.z < 50 ? 50.0F : 10.0F;
              for (std::size_t k = 0; k < out.size(); ++k)
                out[k] = at.y0 + static_cast<float>(k) * at.dy < top ? Material::kBedrock : Material::kAir;
            }};
  return source;
}

// Where a row falls below the cliff's middle, metres from where it should.
double off_the_cliff(const Heightfield& field, int j) {
  for (int i = 0; i + 1 < field.width; ++i) {
    const double a = field.at(i, j), b = field.at(i + 1, j);
    if (a >= 30 && b < 30) return std::abs(i + (a - 30) / (a - b) - (50 - 0.36 * j));
  }
  return 1e9;
}

double largest_off(const Heightfield& field) {
  double largest = 0;
  for (int j = 8; j < field.depth - 8; ++j) largest = std::max(largest, off_the_cliff(field, j));
  return largest;
}

TEST(SceneHeights, CliffsDoNotFollowTheSamplesInSteps) {
  Progress silent;
  EXPECT_GT(largest_off(surface_heights(*cliff().solid, 81, silent)), 0.4);
  EXPECT_LT(largest_off(scene_heights(cliff(), 81, silent)), 0.25);
}

TEST(SceneHeights, LevelGroundStaysWhereItIs) {
  Progress silent;
  const Heightfield field = scene_heights(cliff(), 81, silent);
  EXPECT_NEAR(field.at(5, 40), 50, 0.1);
  EXPECT_NEAR(field.at(75, 40), 10, 0.1);
}

}  // namespace
}  // namespace terrabench
