#include "terrain/sources/fractal/hills.h"

#include <gmock/gmock.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "terrain/error.h"
#include "tests/terrain/errors.h"

namespace terrabench::fractal {
namespace {

using testing::HasSubstr;

// r² − d², cut off at zero, of every hill at every sample.
double by_hand(const std::vector<Hill>& hills, double x, double z) {
  double sum = 0;
  for (const Hill& hill : hills) {
    const double dx = x - hill.x, dz = z - hill.z, r = hill.radius;
    sum += std::max(0.0, r * r - dx * dx - dz * dz);
  }
  return sum;
}

TEST(Hills, AreParaboloidsThatAdd) {
  const HillOptions options{
      .seed = 2, .width = 90, .depth = 140, .cell = 2, .hills = 300, .least_radius = 1, .most_radius = 60};
  const std::vector<Hill> hills = draw_hills(options);
  ASSERT_EQ(hills.size(), 300U);
  const Heightfield field = hill_terrain(options);
  for (int j = 0; j < options.depth; ++j) {
    for (int i = 0; i < options.width; ++i) {
      const double expected = by_hand(hills, 2.0 * i, 2.0 * j);
      ASSERT_NEAR(field.at(i, j), expected, 1e-3 + 3e-6 * expected) << i << ' ' << j;
    }
  }
}

TEST(Hills, OfWholeNumbersAreExact) {
  const HillOptions options{.width = 65, .depth = 65, .cell = 1};
  const std::vector<Hill> hills{{30, 31, 20}, {40, 31, 12},  {-3, 10, 7},
                                {64, 64, 1},  {200, 10, 30}, {10, 50, 0}};
  const Heightfield field = raise_hills(options, hills);
  for (int j = 0; j < 65; ++j) {
    for (int i = 0; i < 65; ++i) ASSERT_EQ(field.at(i, j), by_hand(hills, i, j)) << i << ' ' << j;
  }
  EXPECT_EQ(field.at(30, 31), 400 + 144 - 100);
  EXPECT_EQ(field.at(10, 31), 0) << "at the radius";
  EXPECT_EQ(field.at(64, 63), 0);
}

TEST(Hills, OverlappingInBatchesAddInTheOrderOfTheirNumbers) {
  // More hills than are sorted at a time.
  const HillOptions options{
      .seed = 4, .width = 65, .depth = 65, .cell = 1, .hills = 20000, .least_radius = 1, .most_radius = 9};
  Heightfield expected = raise_hills(options, {});
  for (const Hill& hill : draw_hills(options)) {
    const Heightfield one = raise_hills(options, {hill});
    for (std::size_t i = 0; i < one.heights.size(); ++i) expected.heights[i] += one.heights[i];
  }
  EXPECT_EQ(hill_terrain(options).heights, expected.heights);
}

TEST(Hills, AreScaledUpright) {
  HillOptions options{.width = 33, .depth = 33, .cell = 1};
  const std::vector<Hill> hills{{16, 16, 10}};
  const Heightfield plain = raise_hills(options, hills);
  options.scale = 0.25F;
  const Heightfield scaled = raise_hills(options, hills);
  for (std::size_t i = 0; i < plain.heights.size(); ++i)
    ASSERT_EQ(scaled.heights[i], 0.25F * plain.heights[i]);
}

TEST(Hills, StandOnOrNearTheTerrainWithTheirRadii) {
  const HillOptions options{.seed = 1,
                            .width = 101,
                            .depth = 51,
                            .cell = 10,
                            .hills = 5000,
                            .least_radius = 20,
                            .most_radius = 120};
  double mean = 0;
  int off_the_field = 0;
  for (const Hill& hill : draw_hills(options)) {
    ASSERT_GE(hill.radius, 20);
    ASSERT_LE(hill.radius, 120);
    ASSERT_GE(hill.x, -hill.radius * 1.0001F);
    ASSERT_LE(hill.x, 1000 + hill.radius * 1.0001F);
    ASSERT_GE(hill.z, -hill.radius * 1.0001F);
    ASSERT_LE(hill.z, 500 + hill.radius * 1.0001F);
    mean += hill.radius / 5000;
    off_the_field += hill.x < 0 || hill.x > 1000 || hill.z < 0 || hill.z > 500;
  }
  EXPECT_NEAR(mean, 70, 2);
  EXPECT_GT(off_the_field, 500);
}

TEST(Hills, DependOnTheSeedAlone) {
  const HillOptions options{.seed = 5, .width = 150, .depth = 150};
  const Heightfield expected = hill_terrain(options);
  for (const std::size_t threads : {1, 2, 7}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    EXPECT_EQ(hill_terrain(options).heights, expected.heights);
  }
  EXPECT_EQ(checksum(expected), "a96ca5e53382bda6074e71d1da7dc205");
  HillOptions fewer = options;
  fewer.hills = 100;
  const std::vector<Hill> all = draw_hills(options), some = draw_hills(fewer);
  for (std::size_t k = 0; k < some.size(); ++k) ASSERT_EQ(some[k].x, all[k].x);
}

TEST(Hills, RefuseWhatTheyCannotMake) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  for (const int side : {-1, 0, 1, 1'000'000'000}) {
    EXPECT_EQ(failure_of([&] { hill_terrain({.width = side}); }).code, ExitCode::kUsage) << side;
    EXPECT_EQ(failure_of([&] { hill_terrain({.depth = side}); }).code, ExitCode::kUsage) << side;
  }
  for (const int hills : {-1, 1'000'000'000}) {
    EXPECT_THAT(failure_of([&] { hill_terrain({.hills = hills}); }).what,
                HasSubstr("hills must be between 0 and 10000000,"));
  }
  for (const float bad : {nan, 0.0F, -1.0F, std::numeric_limits<float>::infinity()}) {
    EXPECT_EQ(failure_of([&] { hill_terrain({.least_radius = bad}); }).code, ExitCode::kUsage) << bad;
    EXPECT_EQ(failure_of([&] { hill_terrain({.most_radius = bad}); }).code, ExitCode::kUsage) << bad;
    EXPECT_EQ(failure_of([&] { hill_terrain({.cell = bad}); }).code, ExitCode::kUsage) << bad;
  }
  EXPECT_THAT(failure_of([] { hill_terrain({.least_radius = 9, .most_radius = 3}); }).advice,
              HasSubstr("most_radius"));
  EXPECT_EQ(failure_of([&] { hill_terrain({.scale = nan}); }).code, ExitCode::kUsage);
}

}  // namespace
}  // namespace terrabench::fractal
