// Land from drawings: each of the paper's adjustments does what it says, and nothing else.
#include "terrain/sources/drawing/drawing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "tests/terrain/errors.h"

namespace terrabench {
namespace {

Image ramp() {
  Image picture(256, 3, {});
  for (int y = 0; y < 3; ++y) {
    for (int x = 0; x < 256; ++x) {
      const auto grey = static_cast<std::uint8_t>(x);
      picture.set(x, y, {grey, grey, grey});
    }
  }
  return picture;
}

DrawingOptions plain() {
  DrawingOptions options;
  options.smoothing = 0;
  return options;
}

TEST(Drawing, BlackIsTheSeabedAndWhiteThePeak) {
  DrawingOptions options = plain();
  options.peak = 1500;
  options.seabed = 0.2F;
  options.sea_level = 51.0F / 255;
  const Heightfield field = land_from_drawing(ramp(), options);
  EXPECT_EQ(field.at(0, 0), -300.0F);
  EXPECT_EQ(field.at(51, 0), 0.0F);
  EXPECT_EQ(field.at(255, 0), 1500.0F);
  for (int x = 1; x < 256; ++x) EXPECT_GT(field.at(x, 0), field.at(x - 1, 0)) << x;
  EXPECT_NEAR(field.at(153, 0), 750, 1e-3);
  EXPECT_NEAR(field.at(17, 0), -200, 1e-3);
}

TEST(Drawing, NoSeaAtLevelZeroAndColoursByTheirLuma) {
  DrawingOptions options = plain();
  options.sea_level = 0;
  Image picture(2, 1, {});
  picture.set(1, 0, {0, 255, 0});
  const Heightfield field = land_from_drawing(picture, options);
  EXPECT_EQ(field.at(0, 0), 0.0F);
  EXPECT_NEAR(field.at(1, 0), 587, 2);
}

std::size_t land(const Heightfield& field) {
  return static_cast<std::size_t>(
      std::count_if(field.heights.begin(), field.heights.end(), [](float h) { return h > 0; }));
}

TEST(Drawing, ARisingSeaTakesLandAndAShallowBedWidensTheBeach) {
  const Image picture = example_drawing(128, 3);
  DrawingOptions options;
  std::size_t before = std::numeric_limits<std::size_t>::max();
  for (const float level : {0.1F, 0.3F, 0.4F, 0.5F}) {
    options.sea_level = level;
    const std::size_t now = land(land_from_drawing(picture, options));
    EXPECT_LT(now, before);
    before = now;
  }
  options = {};
  before = 0;
  for (const float bed : {0.6F, 0.3F, 0.1F, 0.03F}) {
    options.seabed = bed;
    const Heightfield field = land_from_drawing(picture, options);
    const auto beach = static_cast<std::size_t>(
        std::count_if(field.heights.begin(), field.heights.end(), [](float h) { return std::abs(h) < 20; }));
    EXPECT_GT(beach, before) << bed;
    before = beach;
  }
}

TEST(Drawing, SmoothingRollsTheHillsAndSparesTheMountains) {
  const Image picture = example_drawing(128, 3);
  DrawingOptions options = plain();
  const Heightfield jagged = land_from_drawing(picture, options);
  double before = std::numeric_limits<double>::infinity();
  for (const int passes : {0, 1, 8, 40}) {
    options.smoothing = passes;
    const Heightfield field = land_from_drawing(picture, options);
    const HeightRange range = height_range(field), full = height_range(jagged);
    EXPECT_GE(range.lowest, full.lowest);
    EXPECT_LE(range.highest, full.highest);
    double bend = 0;
    std::size_t mountains = 0;
    for (int j = 1; j < 127; ++j) {
      for (int i = 1; i < 127; ++i) {
        if (jagged.at(i, j) >= 600) {
          ASSERT_EQ(field.at(i, j), jagged.at(i, j));
          ++mountains;
        } else if (jagged.at(i, j) < 450) {
          bend += std::abs(4 * field.at(i, j) - field.at(i - 1, j) - field.at(i + 1, j) - field.at(i, j - 1) -
                           field.at(i, j + 1));
        }
      }
    }
    EXPECT_GT(mountains, 100U);
    EXPECT_LT(bend, before);
    before = bend;
  }
}

TEST(Drawing, RefusesWhatIsOutOfRange) {
  const auto refused = [](const DrawingOptions& options) {
    EXPECT_EQ(failure_of([&] { land_from_drawing(ramp(), options); }).code, ExitCode::kUsage);
  };
  const float nan = std::numeric_limits<float>::quiet_NaN();
  for (const float bad : {-0.1F, 1.5F, nan}) {
    DrawingOptions options;
    options.sea_level = bad;
    refused(options);
    options = {};
    options.seabed = bad;
    refused(options);
    options = {};
    options.mountains = bad;
    refused(options);
  }
  DrawingOptions options;
  options.cell = 0;
  refused(options);
  options = {};
  options.peak = std::numeric_limits<float>::infinity();
  refused(options);
  options = {};
  options.smoothing = -1;
  refused(options);
  EXPECT_EQ(failure_of([] { land_from_drawing(Image(), {}); }).code, ExitCode::kUsage);
  EXPECT_EQ(failure_of([] { example_drawing(0, 1); }).code, ExitCode::kUsage);
}

TEST(Drawing, AnyShapeOfPicture) {
  for (const auto& [width, height] : {std::pair{1, 1}, {1, 9}, {40, 2}}) {
    const Heightfield field = land_from_drawing(Image(width, height, {255, 255, 255}), {});
    EXPECT_EQ(field.width, width);
    EXPECT_EQ(field.depth, height);
    for (const float h : field.heights) EXPECT_EQ(h, 1000.0F);
  }
}

}  // namespace
}  // namespace terrabench
