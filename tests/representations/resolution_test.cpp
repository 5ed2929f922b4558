// Structures coarser than the ground: their samples stand where they claim to, so that errors are those of
// the sampling and not of a shift.
#include "representations/column_grid.h"
#include "terrain/error.h"
#include "tests/representations/ground.h"
#include "tests/terrain/ground.h"

namespace terrabench::test {
namespace {

constexpr int kWidth = 161, kDepth = 121;

struct Errors {
  double mean = 0, rmse = 0;
};

// Of the top of each column, at every sample of the ground, metres.
Errors errors_of(std::string_view name, const Heightfield& ground, std::int64_t resolution) {
  const auto built = build(name, source_of("ground", ground), resolution);
  std::vector<float> x, z;
  for (int j = 0; j < ground.depth; ++j) {
    for (int i = 0; i < ground.width; ++i) {
      x.push_back(static_cast<float>(i) * ground.cell_x);
      z.push_back(static_cast<float>(j) * ground.cell_z);
    }
  }
  const SpanSink sink = spans_of(*built, {x, z});
  Errors errors;
  for (std::size_t c = 0; c < sink.columns(); ++c) {
    EXPECT_FALSE(sink.column(c).empty()) << name << ", column " << c;
    if (sink.column(c).empty()) return {};
    const double error = static_cast<double>(sink.column(c).back().top) - ground.heights[c];
    errors.mean += error / static_cast<double>(sink.columns());
    errors.rmse += error * error / static_cast<double>(sink.columns());
  }
  errors.rmse = std::sqrt(errors.rmse);
  return errors;
}

Heightfield plane() {
  return ground_of(
      kWidth, kDepth, [](int i, int j) { return 300 + 2.0F * i - 5.0F * j; }, 10, 12);
}

Heightfield waves() {
  return ground_of(
      kWidth, kDepth,
      [](int i, int j) { return 50 * std::sin(0.04F * static_cast<float>(i)) * std::cos(0.05F * j); }, 10,
      10);
}

TEST(Resolution, LinearTypesHoldAPlaneExactly) {
  for (const std::string_view name : {"heightmap", "ght", "procedural_mesh"}) {
    for (const std::int64_t resolution : {2, 7, 33, 80, 100, 321}) {
      EXPECT_LT(errors_of(name, plane(), resolution).rmse, 1e-3) << name << " " << resolution;
    }
  }
}

TEST(Resolution, ColumnsDoNotShiftAPlane) {
  // Columns are level, so that only the mean tells: a shift by half a column of 50 would move it by 5 m. Few
  // samples may lie on the borders of columns, which belong to one side.
  for (const std::string_view name : {"layered_stack", "voxel", "dense_voxel"}) {
    for (const std::int64_t resolution : {20, 33, 50}) {
      EXPECT_LT(std::abs(errors_of(name, plane(), resolution).mean), 0.5) << name << " " << resolution;
    }
  }
}

TEST(Resolution, TheErrorOfSmoothGroundFallsWithTheSquareOfTheSpacing) {
  for (const std::string_view name : {"heightmap", "ght"}) {
    // 10, 20 and 40 cells along the ground, 40 being every fourth sample.
    const double coarse = errors_of(name, waves(), 11).rmse, middle = errors_of(name, waves(), 21).rmse,
                 fine = errors_of(name, waves(), 41).rmse;
    EXPECT_NEAR(std::log2(coarse / middle), 2, 0.25) << name;
    EXPECT_NEAR(std::log2(middle / fine), 2, 0.15) << name;
  }
}

TEST(Resolution, CellsKeepTheirShapeAndOneSampleIsRefused) {
  const Heightfield ground = plane();
  const auto half = at_resolution(ground, 81);
  ASSERT_TRUE(half.has_value());
  EXPECT_EQ(half->width, 81);
  EXPECT_EQ(half->depth, 61);
  EXPECT_FLOAT_EQ(half->cell_x, 20);
  EXPECT_FLOAT_EQ(half->cell_z, 24);
  EXPECT_FALSE(at_resolution(ground, kWidth).has_value());
  EXPECT_EQ(at_resolution(ground, 2)->depth, 2);
  EXPECT_THROW(at_resolution(ground, 1), Error);
}

}  // namespace
}  // namespace terrabench::test
