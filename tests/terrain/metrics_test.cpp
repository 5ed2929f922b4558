#include <gtest/gtest.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <cmath>
#include <random>

#include "terrain/error.h"
#include "terrain/metrics/channel_distance.h"
#include "terrain/metrics/elevation_error.h"
#include "terrain/metrics/nearest_point.h"
#include "tests/terrain/ground.h"

namespace terrabench {
namespace {

Heightfield random_grid(int width, int depth, unsigned seed) {
  return test::random_ground(width, depth, seed, 0, 50, 3, 4.5F);
}

std::vector<std::uint32_t> random_pixels(std::size_t size, double share, unsigned seed) {
  std::mt19937 random(seed);
  std::bernoulli_distribution chosen(share);
  std::vector<std::uint32_t> pixels;
  for (std::uint32_t i = 0; i < size; ++i) {
    if (chosen(random)) pixels.push_back(i);
  }
  std::shuffle(pixels.begin(), pixels.end(), random);
  return pixels;
}

// Equation 3 as it stands, each distance taken by itself.
double slow_mean(const Heightfield& a, const std::vector<std::uint32_t>& from, const Heightfield& b,
                 const std::vector<std::uint32_t>& to, double cell_x, double cell_z, bool elevation) {
  double sum = 0;
  for (const std::uint32_t p : from) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const std::uint32_t q : to) {
      const double x = (static_cast<double>(p % a.width) - static_cast<double>(q % a.width)) * cell_x;
      const double z = (static_cast<double>(p / a.width) - static_cast<double>(q / a.width)) * cell_z;
      const double y = elevation ? static_cast<double>(a.heights[p]) - b.heights[q] : 0;
      nearest = std::min(nearest, std::sqrt(x * x + y * y + z * z));
    }
    sum += nearest;
  }
  return sum / static_cast<double>(from.size());
}

TEST(ElevationError, IsEquationTwo) {
  Heightfield a = random_grid(2, 2, 1), b = a;
  a.heights = {0, 10, 20, 40};
  b.heights = {3, 10, 16, 40};
  const ElevationError error = elevation_error(a, b);
  EXPECT_DOUBLE_EQ(error.rmse, 2.5);
  EXPECT_DOUBLE_EQ(error.largest, 4);
  EXPECT_DOUBLE_EQ(error.range, 40);
  EXPECT_DOUBLE_EQ(error.normalised(), 0.0625);
  EXPECT_EQ(error.pixels, 4U);
}

TEST(ElevationError, LeavesHolesOut) {
  Heightfield a = random_grid(2, 2, 1), b = a;
  a.heights = {0, Heightfield::kNoData, 20, Heightfield::kNoData};
  b.heights = {3, 10, 24, Heightfield::kNoData};
  const ElevationError error = elevation_error(a, b);
  EXPECT_DOUBLE_EQ(error.rmse, std::sqrt(12.5));
  EXPECT_EQ(error.pixels, 2U);
  EXPECT_EQ(error.unmatched, 1U);
}

TEST(ElevationError, FlatOriginalAndUnequalSizes) {
  Heightfield a = random_grid(3, 3, 1), b = a;
  a.heights.assign(9, 5);
  b.heights.assign(9, 5);
  EXPECT_EQ(elevation_error(a, b).normalised(), 0);
  b.heights[4] = 6;
  EXPECT_TRUE(std::isinf(elevation_error(a, b).normalised()));
  EXPECT_THROW(elevation_error(a, random_grid(3, 4, 1)), Error);
}

TEST(DistanceTransform, AgreesWithTryingEveryPoint) {
  for (const auto& [width, depth] : {std::pair{1, 1}, {1, 40}, {40, 1}, {2, 3}, {71, 90}, {90, 71}}) {
    for (const double share : {0.002, 0.05, 0.7}) {
      auto points = random_pixels(static_cast<std::size_t>(width) * depth, share, width + depth);
      if (points.empty()) points.push_back(width * depth - 1);
      const auto squared = squared_distances(width, depth, 1.5, 0.7, points);
      for (int i = 0; i < width * depth; ++i) {
        double nearest = std::numeric_limits<double>::infinity();
        for (const std::uint32_t p : points) {
          const double x = (i % width - static_cast<int>(p) % width) * 1.5;
          const double z = (i / width - static_cast<int>(p) / width) * 0.7;
          nearest = std::min(nearest, x * x + z * z);
        }
        ASSERT_NEAR(squared[i], nearest, 1e-11 * nearest) << i << " of " << width << "×" << depth;
      }
    }
  }
}

TEST(DistanceTransform, WholeDistancesAreExact) {
  const auto points = random_pixels(500 * 300, 0.001, 4);
  for (const double d : squared_distances(500, 300, 1, 1, points)) ASSERT_EQ(d, std::floor(d));
}

TEST(DistanceTransform, NothingIsNearNoPoints) {
  for (const double d : squared_distances(5, 4, 1, 1, {})) EXPECT_TRUE(std::isinf(d));
}

TEST(NearestPoint, AgreesWithTryingEveryPoint) {
  std::mt19937 random(3);
  std::normal_distribution<double> normal(0, 10);
  for (const std::size_t count : {1, 7, 8, 9, 100, 3000}) {
    std::vector<SpacePoint> points(count);
    // Rounded, so that many coordinates are equal.
    for (SpacePoint& p : points) p = {std::round(normal(random)), normal(random), std::round(normal(random))};
    const NearestPoint nearest(points);
    for (int k = 0; k < 200; ++k) {
      const SpacePoint from{normal(random), normal(random), 3 * normal(random)};
      double best = std::numeric_limits<double>::infinity();
      for (const SpacePoint& p : points) {
        best = std::min(
            best, std::pow(p[0] - from[0], 2) + std::pow(p[1] - from[1], 2) + std::pow(p[2] - from[2], 2));
      }
      ASSERT_DOUBLE_EQ(nearest.squared_distance(from), best);
    }
  }
  EXPECT_TRUE(std::isinf(NearestPoint({}).squared_distance({0, 0, 0})));
}

TEST(ChannelDistance, IsEquationThreeInEachReading) {
  const Heightfield a = random_grid(60, 41, 1), b = random_grid(60, 41, 2);
  const auto in_a = random_pixels(a.heights.size(), 0.04, 5), in_b = random_pixels(a.heights.size(), 0.01, 6);
  struct Expected {
    ChannelSpace space;
    double cell_x, cell_z;
    bool elevation;
  };
  for (const Expected& e : {Expected{ChannelSpace::kPlane, 3, 4.5, false},
                            {ChannelSpace::kPlaneSamples, 1, 1, false},
                            {ChannelSpace::kSpace, 3, 4.5, true},
                            {ChannelSpace::kSpaceSamples, 1, 1, true}}) {
    const ChannelDistance distance = channel_distance(a, in_a, b, in_b, e.space);
    EXPECT_NEAR(distance.from_original.mean, slow_mean(a, in_a, b, in_b, e.cell_x, e.cell_z, e.elevation),
                1e-9);
    EXPECT_NEAR(distance.from_other.mean, slow_mean(b, in_b, a, in_a, e.cell_x, e.cell_z, e.elevation), 1e-9);
    EXPECT_EQ(distance.hausdorff(), std::max(distance.from_original.mean, distance.from_other.mean));
    EXPECT_DOUBLE_EQ(distance.corners, std::hypot(59 * e.cell_x, 40 * e.cell_z));
    EXPECT_DOUBLE_EQ(distance.normalised(), distance.hausdorff() / distance.corners);
    EXPECT_NEAR(distance.from_other.sum, distance.from_other.mean * static_cast<double>(in_b.size()), 1e-6);
  }
}

TEST(ChannelDistance, TakesTheLargerMeanWhicheverWayItRuns) {
  Heightfield field = random_grid(11, 1, 1);
  field.cell_x = 1;
  const std::vector<std::uint32_t> one{0}, two{0, 10};
  for (const bool swapped : {false, true}) {
    const ChannelDistance distance =
        channel_distance(field, swapped ? two : one, field, swapped ? one : two, ChannelSpace::kPlane);
    EXPECT_DOUBLE_EQ(distance.hausdorff(), 5);
    EXPECT_DOUBLE_EQ(distance.normalised(), 0.5);
  }
}

// Of three channel pixels one is met, one is 1 and one 9 samples away; the other network's single pixel is
// met.
TEST(ChannelDistance, TheLargestAndTheSumBesideTheMean) {
  Heightfield field = random_grid(11, 1, 1);
  field.cell_x = 2;
  const std::vector<std::uint32_t> many{0, 1, 9}, one{0};
  using enum ChannelAverage;
  const ChannelDistance metres = channel_distance(field, many, field, one, ChannelSpace::kPlane);
  EXPECT_DOUBLE_EQ(metres.hausdorff(kLargest), 18);
  EXPECT_DOUBLE_EQ(metres.hausdorff(kSum), 20);
  EXPECT_DOUBLE_EQ(metres.hausdorff(kMean), 20.0 / 3);
  EXPECT_DOUBLE_EQ(metres.normalised(kLargest), 0.9);
  const ChannelDistance samples = channel_distance(field, one, field, many, ChannelSpace::kPlaneSamples);
  EXPECT_DOUBLE_EQ(samples.hausdorff(kLargest), 9);
  EXPECT_DOUBLE_EQ(samples.normalised(kSum), 1);
}

TEST(ChannelDistance, EqualNetworksAndEmptyOnes) {
  const Heightfield field = random_grid(20, 20, 1);
  const auto channels = random_pixels(400, 0.1, 2);
  for (const auto space : {ChannelSpace::kPlane, ChannelSpace::kSpace, ChannelSpace::kSpaceSamples}) {
    EXPECT_EQ(channel_distance(field, channels, field, channels, space).normalised(), 0);
    EXPECT_EQ(channel_distance(field, {}, field, {}, space).normalised(), 0);
    EXPECT_TRUE(std::isinf(channel_distance(field, channels, field, {}, space).normalised()));
    EXPECT_TRUE(std::isinf(channel_distance(field, {}, field, channels, space).normalised()));
  }
}

TEST(Metrics, SameForAnyNumberOfThreads) {
  const Heightfield a = random_grid(200, 150, 1), b = random_grid(200, 150, 2);
  const auto in_a = random_pixels(a.heights.size(), 0.2, 5), in_b = random_pixels(a.heights.size(), 0.2, 6);
  const double rmse = elevation_error(a, b).rmse;
  const double plane = channel_distance(a, in_a, b, in_b, ChannelSpace::kPlane).hausdorff();
  const double space = channel_distance(a, in_a, b, in_b, ChannelSpace::kSpace).hausdorff();
  for (const int threads : {1, 3}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                    static_cast<std::size_t>(threads));
    tbb::task_arena(threads).execute([&] {
      EXPECT_EQ(elevation_error(a, b).rmse, rmse);
      EXPECT_EQ(channel_distance(a, in_a, b, in_b, ChannelSpace::kPlane).hausdorff(), plane);
      EXPECT_EQ(channel_distance(a, in_a, b, in_b, ChannelSpace::kSpace).hausdorff(), space);
    });
  }
}

}  // namespace
}  // namespace terrabench
