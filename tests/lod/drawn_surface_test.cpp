#include "lod/meters/drawn_surface.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "lod/brute_force/brute_force.h"
#include "lod/lod.h"
#include "lod/meters/surface_raster.h"
#include "tests/lod/drawing.h"
#include "tests/lod/variants.h"

namespace terrabench::test {
namespace {

TEST(DrawnSurface, OfTheFullMeshIsTheFullTerrain) {
  const Heightfield field = hilly(83, 61);
  BruteForce lod(field);
  const DrawnSurface surface(lod.update(from_above(field)), field.width, field.depth);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> x(0, 82), z(0, 60);
  for (int k = 0; k < 2000; ++k) {
    const double u = x(random), v = z(random);
    ASSERT_NEAR(surface.height(u, v), height_on_cells(field, u, v), 1e-4) << u << ' ' << v;
  }
  for (const double u : {0.0, 8.0, 82.0}) EXPECT_EQ(surface.height(u, 60), field.at(static_cast<int>(u), 60));
}

// At samples, it is what SurfaceRaster draws, for every method and its options.
class DrawnSurfaceOf : public ::testing::TestWithParam<Variant> {};

TEST_P(DrawnSurfaceOf, AgreesWithTheRasterAtSamples) {
  const Heightfield field = hilly(90, 70, 0.7F, 1, 5, 5);
  const std::unique_ptr<Lod> lod = build(GetParam(), field, silent());
  View view = from_above(field);
  view.eye.y = 60;
  const Frame& frame = lod->update(view);
  const DrawnSurface surface(frame, field.width, field.depth);
  const SurfaceRaster raster(frame, field.width, field.depth);
  std::size_t drawn = 0;
  for (int j = 0; j < field.depth; ++j) {
    for (int i = 0; i < field.width; ++i) {
      const float height = surface.height(i, j);
      ASSERT_EQ(std::isnan(height), !raster.is_drawn(i, j)) << i << ' ' << j;
      if (std::isnan(height)) continue;
      ASSERT_NEAR(height, raster.at(i, j), 1e-4);
      ++drawn;
    }
  }
  EXPECT_GT(drawn, 100U);
}

INSTANTIATE_TEST_SUITE_P(Registry, DrawnSurfaceOf, ::testing::ValuesIn(variants()), name_of);

TEST(DrawnSurface, TakesTheHighestAndKnowsWhereNothingIs) {
  Heightfield field = flat(33, 33);
  for (int j = 0; j < 33; ++j) field.at(32, j) = 32;
  Drawing one(field), other(field);  // one triangle rises from 0 to 32 along x, the other lies flat
  one.triangle({0, 0}, {0, 32}, {32, 0});
  one.triangle({0, 0}, {0, 16}, {16, 0});
  other.triangle({0, 0}, {0, 16}, {16, 0});
  other.triangle({0, 0}, {0, 32}, {32, 0});
  for (const Drawing* const drawing : {&one, &other}) {
    const DrawnSurface surface(drawing->frame(), 33, 33);
    EXPECT_NEAR(surface.height(4.5, 3), 4.5, 1e-5);
    EXPECT_TRUE(std::isnan(surface.height(31.5, 31.5)));
    EXPECT_EQ(surface.triangles(), 2U);
    EXPECT_GE(surface.bytes(), 2 * 3 * sizeof(Corner));
  }
}

}  // namespace
}  // namespace terrabench::test
