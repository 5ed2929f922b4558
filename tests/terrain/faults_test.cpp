#include "terrain/sources/fractal/faults.h"

#include <gmock/gmock.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "terrain/error.h"
#include "tests/terrain/errors.h"

namespace terrabench::fractal {
namespace {

using testing::HasSubstr;

// Every sample against every line.
std::vector<double> by_hand(const FaultOptions& options) {
  std::vector<double> heights(static_cast<std::size_t>(options.width) * options.depth, 0.0);
  for (const FaultLine& line : fault_lines(options)) {
    for (int j = 0; j < options.depth; ++j) {
      for (int i = 0; i < options.width; ++i) {
        heights[static_cast<std::size_t>(j) * options.width + i] +=
            line.rises(i, j) ? options.step : -options.step;
      }
    }
  }
  return heights;
}

TEST(Faults, AddAndTakeAsEveryLineSays) {
  const std::array grounds{FaultOptions{.seed = 1, .width = 97, .depth = 61, .faults = 300, .step = 3},
                           FaultOptions{.seed = 2, .width = 2, .depth = 2, .faults = 40, .step = 0.5F},
                           FaultOptions{.seed = 3, .width = 3, .depth = 200, .faults = 50, .step = 1},
                           FaultOptions{.seed = 4, .width = 200, .depth = 2, .faults = 50, .step = 1}};
  for (const FaultOptions& options : grounds) {
    const Heightfield field = fault_terrain(options);
    ASSERT_EQ(field.width, options.width);
    ASSERT_EQ(field.depth, options.depth);
    const std::vector<double> expected = by_hand(options);
    for (std::size_t i = 0; i < expected.size(); ++i) {
      ASSERT_EQ(field.heights[i], static_cast<float>(expected[i]))
          << "seed " << options.seed << ", sample " << i;
    }
  }
}

TEST(Faults, MoveEveryLineOnce) {
  FaultOptions options{.seed = 6, .width = 129, .depth = 129, .faults = 0, .step = 4};
  Heightfield before = fault_terrain(options);
  for (const float height : before.heights) ASSERT_EQ(height, 0);
  for (int faults = 1; faults < 60; ++faults) {
    options.faults = faults;
    const Heightfield after = fault_terrain(options);
    std::size_t up = 0, down = 0;
    for (std::size_t i = 0; i < after.heights.size(); ++i) {
      up += after.heights[i] == before.heights[i] + 4;
      down += after.heights[i] == before.heights[i] - 4;
    }
    EXPECT_EQ(up + down, after.heights.size());
    EXPECT_GT(up, 0U) << "every line leaves ground on both sides";
    EXPECT_GT(down, 0U);
    before = after;
  }
}

TEST(Faults, RunInAllDirectionsAlike) {
  std::array<int, 12> directions{};
  double high = 0;
  constexpr int kFaults = 12000;
  const FaultOptions options{.width = 100, .depth = 100, .faults = kFaults, .step = 1};
  for (const FaultLine& line : fault_lines(options)) {
    const double turn =
        std::atan2(static_cast<double>(line.b), static_cast<double>(line.a)) / (2 * std::numbers::pi);
    ++directions[static_cast<std::size_t>(std::clamp(static_cast<int>((turn + 0.5) * 12), 0, 11))];
    high += line.rises(50, 50);
  }
  for (const int count : directions) EXPECT_NEAR(count, 1000, 130);  // four standard deviations
  EXPECT_NEAR(high / kFaults, 0.5, 0.02);
}

TEST(Faults, DependOnTheSeedAlone) {
  const FaultOptions options{.seed = 5, .width = 200, .depth = 150, .faults = 100};
  const Heightfield expected = fault_terrain(options);
  for (const std::size_t threads : {1, 2, 7}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    EXPECT_EQ(fault_terrain(options).heights, expected.heights);
  }
  EXPECT_EQ(checksum(expected), "37b240f205a09f8db632ca9d402586eb");
  FaultOptions other = options;
  other.seed = 6;
  EXPECT_NE(fault_terrain(other).heights, expected.heights);
}

TEST(PlanetFaults, AddAndTakeAsEveryPlaneSays) {
  const PlanetFaultOptions options{.seed = 3, .width = 73, .depth = 37, .faults = 500, .step = 1};
  const Heightfield field = planet_faults(options);
  const std::vector<FaultPlane> planes = fault_planes(options);
  for (int j = 0; j < options.depth; ++j) {
    const double latitude = std::numbers::pi * (0.5 - static_cast<double>(j) / (options.depth - 1));
    for (int i = 0; i < options.width; ++i) {
      const double longitude = 2 * std::numbers::pi * (static_cast<double>(i) / (options.width - 1) - 0.5);
      const double x = std::cos(latitude) * std::cos(longitude), z = std::cos(latitude) * std::sin(longitude);
      int expected = 0, unclear = 0;  // too near to the plane for the sines of two libraries
      for (const FaultPlane& plane : planes) {
        const double height = plane.x * x + plane.y * std::sin(latitude) + plane.z * z - plane.offset;
        expected += height > 0 ? 1 : -1;
        unclear += std::abs(height) < 1e-12;
      }
      ASSERT_NEAR(field.at(i, j), expected, 2 * unclear) << i << ' ' << j;
    }
  }
}

TEST(PlanetFaults, HaveNoSeamAndOneHeightAtEachPole) {
  const PlanetFaultOptions options{.seed = 9, .width = 257, .depth = 129, .faults = 400, .step = 10};
  const Heightfield field = planet_faults(options);
  for (int j = 0; j < 129; ++j) ASSERT_EQ(field.at(0, j), field.at(256, j)) << j;
  for (int i = 0; i < 257; ++i) {
    ASSERT_EQ(field.at(i, 0), field.at(0, 0)) << i;
    ASSERT_EQ(field.at(i, 128), field.at(0, 128)) << i;
  }
  // The date line is a meridian like any other: steps across it are no larger than elsewhere.
  const auto roughness = [&](int i) {
    double sum = 0;
    for (int j = 0; j < 129; ++j) sum += std::abs(field.at((i + 1) % 256, j) - field.at(i, j));
    return sum;
  };
  double most = 0;
  for (int i = 0; i < 255; ++i) most = std::max(most, roughness(i));
  EXPECT_LE(roughness(255), most);
  EXPECT_GT(most, 0);
}

TEST(PlanetFaults, DependOnTheSeedAlone) {
  const PlanetFaultOptions options{.seed = 5, .width = 130, .depth = 66, .faults = 200};
  const Heightfield expected = planet_faults(options);
  for (const std::size_t threads : {1, 2, 7}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    EXPECT_EQ(planet_faults(options).heights, expected.heights);
  }
  EXPECT_EQ(checksum(expected), "4f790b64a4c3849a8ae41f60cf6ef985");
}

TEST(Faults, RefuseWhatTheyCannotMake) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  for (const int side : {-1, 0, 1, 1'000'000'000}) {
    EXPECT_EQ(failure_of([&] { fault_terrain({.width = side}); }).code, ExitCode::kUsage) << side;
    EXPECT_EQ(failure_of([&] { fault_terrain({.depth = side}); }).code, ExitCode::kUsage) << side;
    EXPECT_EQ(failure_of([&] { planet_faults({.width = side}); }).code, ExitCode::kUsage) << side;
    EXPECT_EQ(failure_of([&] { planet_faults({.depth = side}); }).code, ExitCode::kUsage) << side;
  }
  for (const int faults : {-1, 1'000'000'000}) {
    EXPECT_THAT(failure_of([&] { fault_terrain({.faults = faults}); }).what, HasSubstr("faults must be"));
    EXPECT_THAT(failure_of([&] { planet_faults({.faults = faults}); }).what, HasSubstr("0 and 1000000,"));
  }
  for (const float bad : {nan, -1.0F, std::numeric_limits<float>::infinity()}) {
    EXPECT_EQ(failure_of([&] { fault_terrain({.step = bad}); }).code, ExitCode::kUsage) << bad;
    EXPECT_EQ(failure_of([&] { fault_terrain({.cell = bad}); }).code, ExitCode::kUsage) << bad;
    EXPECT_EQ(failure_of([&] { planet_faults({.radius = bad}); }).code, ExitCode::kUsage) << bad;
  }
}

}  // namespace
}  // namespace terrabench::fractal
