// The raster misses no sample, adds none, and interpolates linearly.
#include "lod/meters/surface_raster.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>

#include "lod/brute_force/brute_force.h"
#include "tests/lod/drawing.h"

namespace terrabench::test {
namespace {

TEST(SurfaceRaster, GivesFullDetailBackExactly) {
  Heightfield field = hilly(70, 45, 3);
  field.cell_x = 30.7F;
  field.cell_z = 0.3F;
  BruteForce lod(field);
  const SurfaceRaster raster(lod.update(from_above(field)), field.width, field.depth);
  for (int j = 0; j < field.depth; ++j) {
    for (int i = 0; i < field.width; ++i) ASSERT_EQ(raster.at(i, j), field.at(i, j)) << i << ' ' << j;
  }
}

TEST(SurfaceRaster, InterpolatesInsideAndOnEdges) {
  Heightfield field = flat(9, 9);
  field.at(0, 0) = 8;
  field.at(8, 0) = 16;
  field.at(0, 8) = 32;
  field.at(4, 4) = 1000;  // not drawn
  Drawing drawing(field);
  drawing.triangle({0, 0}, {0, 8}, {8, 0});
  const SurfaceRaster raster(drawing.frame(), 9, 9);
  for (int j = 0; j < 9; ++j) {
    for (int i = 0; i < 9; ++i) {
      if (i + j > 8) {
        EXPECT_FALSE(raster.is_drawn(i, j)) << i << ' ' << j;
      } else {
        EXPECT_EQ(raster.at(i, j), 8 + static_cast<float>(i) + 3 * static_cast<float>(j)) << i << ' ' << j;
      }
    }
  }
}

// Fans from a random sample to samples of the rim in uneven strides, which give slivers of every slope.
TEST(SurfaceRaster, CoversEverySampleOfAnyTriangulation) {
  constexpr int kSide = 41;
  std::mt19937 random(5);
  for (int round = 0; round < 200; ++round) {
    const Heightfield field = hilly(kSide, kSide, 5, static_cast<unsigned>(round));
    const auto below = [&](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
    const glm::ivec2 middle(1 + below(kSide - 2), 1 + below(kSide - 2));
    std::vector<glm::ivec2> rim;
    const auto walk = [&](auto corner) {
      for (int t = 0; t < kSide - 1; t += std::min(1 + below(9), kSide - 1 - t)) rim.push_back(corner(t));
    };
    walk([](int t) { return glm::ivec2(0, t); });
    walk([](int t) { return glm::ivec2(t, kSide - 1); });
    walk([](int t) { return glm::ivec2(kSide - 1, kSide - 1 - t); });
    walk([](int t) { return glm::ivec2(kSide - 1 - t, 0); });
    Drawing drawing(field);
    for (std::size_t k = 0; k < rim.size(); ++k) {
      drawing.triangle(middle, rim[k], rim[(k + 1) % rim.size()]);
    }
    const SurfaceRaster raster(drawing.frame(), kSide, kSide);
    for (int j = 0; j < kSide; ++j) {
      for (int i = 0; i < kSide; ++i) ASSERT_TRUE(raster.is_drawn(i, j)) << round << ": " << i << ' ' << j;
    }
    ASSERT_EQ(raster.at(middle.x, middle.y), field.at(middle.x, middle.y));
  }
}

TEST(SurfaceRaster, KeepsTheHighestAndLeavesOutWhatHasNoPlan) {
  Heightfield field = flat(5, 5);
  field.at(4, 4) = field.at(4, 0) = field.at(0, 4) = 4;
  Drawing drawing(field);
  drawing.triangle({0, 0}, {0, 4}, {4, 0});
  drawing.triangle({0, 0}, {0, 4}, {4, 4});  // over the first, higher or level
  drawing.triangle({4, 0}, {4, 2}, {4, 4});  // upright
  const SurfaceRaster raster(drawing.frame(), 5, 5);
  EXPECT_EQ(raster.at(1, 1), 2);
  EXPECT_EQ(raster.at(1, 2), 3);
  EXPECT_EQ(raster.at(3, 3), 3);
  EXPECT_FALSE(raster.is_drawn(4, 2));
}

TEST(SurfaceRaster, DrawsNothingThatFacesDown) {
  const Heightfield field = flat(9, 9);
  Drawing drawing(field);
  drawing.triangle({0, 0}, {0, 8}, {8, 0});
  drawing.triangle({8, 0}, {8, 8}, {0, 8});
  const SurfaceRaster raster(drawing.frame(), 9, 9);
  EXPECT_TRUE(raster.is_drawn(4, 4));
  EXPECT_FALSE(raster.is_drawn(5, 4));
  EXPECT_FALSE(raster.is_drawn(8, 8));
}

TEST(SurfaceRaster, IsTheSameForAnyNumberOfThreads) {
  const Heightfield field = hilly(200, 150, 4);
  Drawing drawing(field);
  for (int j = 0; j + 7 < 150; j += 5) {
    for (int i = 0; i + 7 < 200; i += 5) drawing.square(i, j, 7);  // overlapping
  }
  SurfaceRaster many(drawing.frame(), 200, 150);
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  const SurfaceRaster single(drawing.frame(), 200, 150);
  for (int j = 0; j < 150; ++j) {
    for (int i = 0; i < 200; ++i) {
      ASSERT_EQ(many.is_drawn(i, j), single.is_drawn(i, j));
      if (many.is_drawn(i, j)) {
        ASSERT_EQ(many.at(i, j), single.at(i, j));
      }
    }
  }
}

}  // namespace
}  // namespace terrabench::test
