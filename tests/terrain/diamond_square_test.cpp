#include "terrain/sources/fractal/diamond_square.h"

#include <gmock/gmock.h>
#include <hwy/targets.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "terrain/error.h"
#include "terrain/memory.h"
#include "terrain/sources/fractal/counter_random.h"
#include "terrain/sources/fractal/limits.h"
#include "terrain/sources/fractal/midpoint.h"
#include "tests/terrain/errors.h"

namespace terrabench::fractal {
namespace {

using testing::HasSubstr;

// As the textbook tells it: steps within the one array, point by point, indices modulo the side.
Heightfield step_by_step(const DiamondSquareOptions& options) {
  const int last = options.side - 1, levels = levels_of_side(options.side);
  Heightfield field;
  field.width = field.depth = options.side;
  field.cell_x = field.cell_z = options.cell;
  field.heights.assign(static_cast<std::size_t>(options.side) * options.side, 0);
  const auto wrapped = [&](int x, int z) { return field.at((x + last) % last, (z + last) % last); };
  field.at(0, 0) = options.corner;
  for (int level = 0; level < levels; ++level) {
    const int half = last >> (level + 1);
    const float range = level_range(options.amplitude, options.hurst, level);
    const auto moved = [&](int x, int z) {
      const auto row = static_cast<std::uint64_t>(level) << 32 | static_cast<std::uint32_t>(z / half);
      return range *
             displacement(row_key(options.seed, kDiamondSquare, row), static_cast<std::uint32_t>(x / half));
    };
    for (int z = half; z < last; z += 2 * half) {
      for (int x = half; x < last; x += 2 * half) {
        const float west = wrapped(x - half, z - half), east = wrapped(x + half, z - half);
        const float south_west = wrapped(x - half, z + half), south_east = wrapped(x + half, z + half);
        field.at(x, z) = 0.25F * ((west + east) + (south_west + south_east)) + moved(x, z);
      }
    }
    for (int z = 0; z < last; z += half) {
      for (int x = (z / half) % 2 == 0 ? half : 0; x < last; x += 2 * half) {
        const float north = wrapped(x, z - half), south = wrapped(x, z + half);
        const float west = wrapped(x - half, z), east = wrapped(x + half, z);
        const float mean = (z / half) % 2 == 0 ? 0.25F * ((west + east) + (north + south))
                                               : 0.25F * ((north + south) + (west + east));
        field.at(x, z) = mean + moved(x, z);
      }
    }
  }
  for (int i = 0; i < last; ++i) {
    field.at(last, i) = field.at(0, i);
    field.at(i, last) = field.at(i, 0);
  }
  field.at(last, last) = options.corner;
  return field;
}

TEST(DiamondSquare, IsTheTextbooksToTheLastBit) {
  for (const int side : {3, 5, 9, 17, 33, 65, 129, 257, 513, 1025}) {
    const DiamondSquareOptions options{.seed = 7, .side = side, .corner = -3};
    EXPECT_EQ(diamond_square(options).heights, step_by_step(options).heights) << side;
  }
}

TEST(DiamondSquare, ClosesOnItself) {
  const Heightfield field = diamond_square({.seed = 3, .side = 257});
  ASSERT_EQ(field.width, 257);
  ASSERT_EQ(field.depth, 257);
  for (int i = 0; i < 257; ++i) {
    ASSERT_EQ(field.at(0, i), field.at(256, i)) << i;
    ASSERT_EQ(field.at(i, 0), field.at(i, 256)) << i;
  }
  EXPECT_EQ(field.at(0, 0), 0);
  EXPECT_EQ(field.at(256, 256), 0);
  // Not by being flat there.
  EXPECT_NE(field.at(0, 100), field.at(0, 101));
}

TEST(DiamondSquare, DependsOnTheSeedAlone) {
  const DiamondSquareOptions options{.seed = 5, .side = 513};
  const Heightfield expected = diamond_square(options);
  for (const std::size_t threads : {1, 2, 3, 8}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    EXPECT_EQ(diamond_square(options).heights, expected.heights) << threads << " threads";
  }
  DiamondSquareOptions other = options;
  other.seed = 6;
  const Heightfield changed = diamond_square(other);
  std::size_t equal = 0;
  for (std::size_t i = 0; i < expected.heights.size(); ++i)
    equal += expected.heights[i] == changed.heights[i];
  EXPECT_LT(equal, expected.heights.size() / 1000);
}

// Values that every machine and compiler must give.
TEST(DiamondSquare, HasKnownBits) {
  EXPECT_EQ(checksum(diamond_square({.seed = 1, .side = 129})), "2dd5145a9569e18071dd3d7f720ea8b9");
}

TEST(DiamondSquare, IsTheSameInEveryInstructionSet) {
  const DiamondSquareOptions options{.seed = 5, .side = 65};
  const Heightfield expected = diamond_square(options);
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
    hwy::SetSupportedTargetsForTest(target);
    EXPECT_EQ(diamond_square(options).heights, expected.heights) << hwy::TargetName(target);
  }
  hwy::SetSupportedTargetsForTest(0);
}

TEST(DiamondSquare, OfFewerLevelsIsTheCoarsePart) {
  const Heightfield coarse = diamond_square({.seed = 11, .side = 65}),
                    fine = diamond_square({.seed = 11, .side = 513});
  for (int z = 0; z < 65; ++z) {
    for (int x = 0; x < 65; ++x) ASSERT_EQ(coarse.at(x, z), fine.at(8 * x, 8 * z)) << x << ' ' << z;
  }
}

TEST(DiamondSquare, ShowsItsSteps) {
  const DiamondSquareOptions options{.seed = 2, .side = 5};
  const Heightfield whole = diamond_square(options);
  const std::vector<int> expected_set{4, 5, 9, 13, 25};
  for (int steps = 0; steps <= 4; ++steps) {
    const Heightfield stage = diamond_square_after(options, steps);
    int set = 0;
    for (std::size_t i = 0; i < stage.heights.size(); ++i) {
      if (Heightfield::is_no_data(stage.heights[i])) continue;
      ++set;
      EXPECT_EQ(stage.heights[i], whole.heights[i]);
    }
    EXPECT_EQ(set, expected_set[static_cast<std::size_t>(steps)]) << steps;
  }
  EXPECT_FALSE(Heightfield::is_no_data(diamond_square_after(options, 1).at(2, 2)));
  EXPECT_FALSE(Heightfield::is_no_data(diamond_square_after(options, 2).at(2, 0)));
  EXPECT_FALSE(Heightfield::is_no_data(diamond_square_after(options, 3).at(1, 3)));
  EXPECT_THROW(diamond_square_after(options, -1), Error);
  EXPECT_THROW(diamond_square_after(options, 5), Error);
}

// Mean distance of the points of one level from the mean of the four they come from.
double mean_displacement(const Heightfield& field, int level) {
  const int last = field.width - 1, half = last >> (level + 1);
  double sum = 0;
  int count = 0;
  for (int z = half; z < last; z += 2 * half) {
    for (int x = half; x < last; x += 2 * half) {
      const double mean =
          0.25 * (static_cast<double>(field.at(x - half, z - half)) + field.at(x + half, z - half) +
                  field.at(x - half, z + half) + field.at(x + half, z + half));
      sum += std::abs(field.at(x, z) - mean);
      ++count;
    }
  }
  return sum / count;
}

TEST(DiamondSquare, ReducesItsRangeByLevel) {
  for (const float hurst : {1.0F, 0.5F}) {
    const Heightfield field = diamond_square({.seed = 4, .side = 513, .amplitude = 100, .hurst = hurst});
    for (int level = 5; level < 8; ++level) {
      EXPECT_NEAR(mean_displacement(field, level + 1) / mean_displacement(field, level), std::exp2(-hurst),
                  0.03)
          << level;
    }
    // Evenly spread over the range: half of it on average.
    EXPECT_NEAR(mean_displacement(field, 8), 50 * std::exp2(-8.0 * hurst),
                0.02 * 50 * std::exp2(-8.0 * hurst));
  }
}

// The mean square difference over a distance d grows as d^2H.
TEST(DiamondSquare, HasTheRoughnessOfItsHurstExponent) {
  for (const float hurst : {0.3F, 0.5F, 0.7F}) {
    double slope = 0;
    constexpr int kSeeds = 6;
    for (int seed = 1; seed <= kSeeds; ++seed) {
      const Heightfield field =
          diamond_square({.seed = static_cast<std::uint64_t>(seed), .side = 513, .hurst = hurst});
      const auto variogram = [&](int lag) {
        double sum = 0;
        for (int z = 0; z < 512; ++z) {
          for (int x = 0; x < 512; ++x) {
            const double difference = field.at((x + lag) % 512, z) - field.at(x, z);
            sum += difference * difference;
          }
        }
        return sum;
      };
      slope += std::log2(variogram(32) / variogram(2)) / 4 / kSeeds;
    }
    EXPECT_NEAR(slope / 2, hurst, 0.1) << hurst;
  }
}

TEST(DiamondSquare, NeedsTheMemoryOfItsOutputAndAQuarter) {
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, 2);
  diamond_square({.side = 257});  // whatever the threads keep
  HeapCounter::reset_peak();
  const std::int64_t before = HeapCounter::live();
  const Heightfield field = diamond_square({.side = 2049});
  const auto output = static_cast<std::int64_t>(field.heights.size() * sizeof(float));
  EXPECT_LT(HeapCounter::peak() - before, output + output / 4 + output / 50);
}

TEST(DiamondSquare, RefusesWhatItCannotMake) {
  const float nan = std::numeric_limits<float>::quiet_NaN(),
              infinity = std::numeric_limits<float>::infinity();
  for (const int side : {-5, 0, 1, 2, 4, 6, 512, 514, 1'000'000'000, 65537}) {
    const Failure failure = failure_of([&] { diamond_square({.side = side}); });
    EXPECT_EQ(failure.code, ExitCode::kUsage) << side;
    EXPECT_THAT(failure.what, HasSubstr("2^n + 1")) << side;
  }
  for (const float bad : {nan, infinity, -1.0F}) {
    EXPECT_EQ(failure_of([&] { diamond_square({.amplitude = bad}); }).code, ExitCode::kUsage) << bad;
    EXPECT_EQ(failure_of([&] { diamond_square({.hurst = bad}); }).code, ExitCode::kUsage) << bad;
    EXPECT_EQ(failure_of([&] { diamond_square({.cell = bad}); }).code, ExitCode::kUsage) << bad;
  }
  EXPECT_THAT(failure_of([&] { diamond_square({.hurst = 1.5F}); }).what,
              HasSubstr("hurst must be between 0 and 1, got 1.5"));
  EXPECT_EQ(failure_of([&] { diamond_square({.corner = nan}); }).code, ExitCode::kUsage);
  EXPECT_EQ(failure_of([&] { diamond_square({.cell = 0}); }).code, ExitCode::kUsage);
  for (const float height : diamond_square({.side = 129, .amplitude = 0}).heights) ASSERT_EQ(height, 0);
}

TEST(Midpoint, KeepsItsEndsAndItsPointsFromLevelToLevel) {
  const MidpointOptions options{.seed = 9, .levels = 8, .amplitude = 2, .left = 5, .right = -5};
  const std::vector<float> fine = midpoint_displacement(options);
  ASSERT_EQ(fine.size(), 257U);
  EXPECT_EQ(fine.front(), 5);
  EXPECT_EQ(fine.back(), -5);
  for (int levels = 0; levels < 8; ++levels) {
    MidpointOptions fewer = options;
    fewer.levels = levels;
    const std::vector<float> coarse = midpoint_displacement(fewer);
    ASSERT_EQ(coarse.size(), (std::size_t{1} << levels) + 1);
    for (std::size_t i = 0; i < coarse.size(); ++i) ASSERT_EQ(coarse[i], fine[i << (8 - levels)]);
  }
}

TEST(Midpoint, MovesEachMiddleWithinTheRangeOfItsLevel) {
  const std::vector<float> line = midpoint_displacement({.seed = 1, .levels = 12, .amplitude = 8});
  const std::size_t last = line.size() - 1;
  for (int level = 0; level < 12; ++level) {
    const std::size_t half = last >> (level + 1);
    const double range = 8 * std::exp2(-level);
    double most = 0;
    for (std::size_t i = half; i < last; i += 2 * half) {
      most = std::max(most, std::abs(line[i] - 0.5 * (static_cast<double>(line[i - half]) + line[i + half])));
    }
    EXPECT_LE(most, range * 1.000001) << level;
    if (level > 5) {
      EXPECT_GT(most, 0.8 * range) << level;
    }
  }
}

TEST(Midpoint, RefusesWhatItCannotMake) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THAT(failure_of([] { midpoint_displacement({.levels = 25}); }).what, HasSubstr("0 and 24, got 25"));
  EXPECT_EQ(failure_of([] { midpoint_displacement({.levels = -1}); }).code, ExitCode::kUsage);
  EXPECT_EQ(failure_of([&] { midpoint_displacement({.amplitude = nan}); }).code, ExitCode::kUsage);
  EXPECT_EQ(failure_of([&] { midpoint_displacement({.left = nan}); }).code, ExitCode::kUsage);
}

}  // namespace
}  // namespace terrabench::fractal
