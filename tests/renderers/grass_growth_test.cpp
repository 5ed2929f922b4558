// Where grass grows and how much: decided on the processor.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>

#include "renderers/grass/growth.h"
#include "renderers/grass/texture.h"
#include "tests/renderers/meadow.h"
#include "tests/terrain/errors.h"

namespace terrabench {
namespace {

using ::testing::HasSubstr;

// One triangle tilted by this angle against level ground, about a horizontal axis.
TriangleMesh tilted(double degrees) {
  const double angle = degrees * std::numbers::pi / 180;
  const auto cosine = static_cast<float>(std::cos(angle)), sine = static_cast<float>(std::sin(angle));
  TriangleMesh mesh;
  mesh.positions = {{0, 0, 0}, {0, 0, 1}, {cosine, sine, 0}};
  mesh.indices = {0, 1, 2};
  compute_normals(mesh);
  return mesh;
}

TEST(GrassSlope, ReadingsAgreeOnLevelAndUprightGroundOnly) {
  for (const SlopeAngle reading : {SlopeAngle::kPrinted, SlopeAngle::kTrue}) {
    EXPECT_DOUBLE_EQ(slope_angle(1, reading), 0);
    EXPECT_DOUBLE_EQ(slope_angle(0, reading), 90);
    EXPECT_DOUBLE_EQ(slope_angle(-1, reading), 180);
  }
  EXPECT_NEAR(slope_angle(std::sqrt(0.5), SlopeAngle::kTrue), 45, 1e-9);
  EXPECT_NEAR(slope_angle(std::sqrt(0.5), SlopeAngle::kPrinted), 26.36, 0.005);
  // Where the derivatives are equal: 1 / sqrt(1 - y²) = π / 2.
  const double y = std::sqrt(1 - 4 / (std::numbers::pi * std::numbers::pi));
  double largest = 0;
  for (int i = 0; i <= 100'000; ++i) {
    const double at = i * 1e-5;
    largest = std::max(largest, slope_angle(at, SlopeAngle::kTrue) - slope_angle(at, SlopeAngle::kPrinted));
  }
  EXPECT_NEAR(largest, slope_angle(y, SlopeAngle::kTrue) - slope_angle(y, SlopeAngle::kPrinted), 1e-6);
  EXPECT_NEAR(largest, 18.95, 0.005);
}

TEST(GrassSlope, LimitKeepsSteepGroundBare) {
  struct Expected {
    double tilt;
    float limit;
    bool printed, by_true_angle;
  };
  // 50° is 32.1° by the printed formula; a ceiling is 180°.
  for (const Expected& e : {Expected{0, 0.01F, true, true},
                            {50, 33, true, false},
                            {50, 31, false, false},
                            {50, 51, true, true},
                            {89, 80, false, false},
                            {100, 89, false, false},
                            {180, 179, false, false}}) {
    SCOPED_TRACE(e.tilt);
    const TriangleMesh mesh = tilted(e.tilt);
    GrassGrowth growth{.strands = 7, .steepest = e.limit};
    EXPECT_EQ(plan_grass(grass_ground(mesh), growth).strands(), e.printed ? 7 : 0);
    growth.slope = SlopeAngle::kTrue;
    EXPECT_EQ(plan_grass(grass_ground(mesh), growth).strands(), e.by_true_angle ? 7 : 0);
  }
}

TEST(GrassPlan, CountsTheTrianglesBelowTheLimit) {
  const TriangleMesh mesh = meadow(40);
  std::size_t before = 0;
  for (const float limit : {2.0F, 10.0F, 30.0F, 60.0F}) {
    std::size_t expected = 0;
    for (std::size_t t = 0; t < mesh.indices.size(); t += 3) {
      const glm::dvec3 a(mesh.positions[mesh.indices[t]]), b(mesh.positions[mesh.indices[t + 1]]),
          c(mesh.positions[mesh.indices[t + 2]]);
      if ((1 - glm::normalize(glm::cross(b - a, c - a)).y) * 90 <= limit) ++expected;
    }
    const GrassPlan plan = plan_grass(grass_ground(mesh), {.strands = 10'000, .steepest = limit});
    EXPECT_EQ(plan.growing(), expected);
    EXPECT_GT(expected, before);
    before = expected;
  }
  EXPECT_LT(before, mesh.triangles() + 1);
}

TEST(GrassPlan, SpreadsTheStrandsEvenly) {
  const TriangleMesh mesh = meadow(31);
  for (const std::int64_t strands : {0L, 1L, 5'000L, 41'960L, 83'920L, 125'880L}) {
    const GrassPlan plan = plan_grass(grass_ground(mesh), {.strands = strands, .steepest = 20});
    ASSERT_EQ(plan.strands(), strands);
    std::uint32_t least = std::numeric_limits<std::uint32_t>::max(), most = 0;
    std::vector<std::uint32_t> counts;
    for (std::size_t t = 0; t < plan.growing(); ++t) {
      counts.push_back(plan.triangles[t + 1].w - plan.triangles[t].w);
      least = std::min(least, counts.back());
      most = std::max(most, counts.back());
    }
    EXPECT_LE(most - least, 1U);
    // The runs list every triangle that grows a strand, once.
    std::vector<std::uint32_t> listed(counts.size());
    for (const GrassPlan::Run& run : plan.runs) {
      for (std::uint32_t t = run.first; t < run.first + run.triangles; ++t) listed[t] += run.strands;
    }
    EXPECT_EQ(listed, counts);
    EXPECT_LE(plan.runs.size(), 2U);
  }
}

TEST(GrassPlan, SpreadsByAreaWhereAsked) {
  TriangleMesh mesh;
  mesh.positions = {{0, 0, 0}, {0, 0, 3}, {3, 0, 0}, {10, 0, 0}, {10, 0, 1}, {11, 0, 0}};
  mesh.indices = {0, 1, 2, 3, 4, 5};  // areas 4.5 and 0.5
  compute_normals(mesh);
  EXPECT_EQ(plan_grass(grass_ground(mesh), {.strands = 1000}).triangles[1].w, 500U);
  EXPECT_EQ(plan_grass(grass_ground(mesh), {.strands = 1000, .by_area = true}).triangles[1].w, 900U);
}

TEST(GrassPlan, LeavesOutWhatIsNoTriangle) {
  TriangleMesh mesh = meadow(4);
  const std::size_t all = plan_grass(grass_ground(mesh), {.strands = 100, .steepest = 180}).growing();
  EXPECT_EQ(all, mesh.triangles());
  mesh.indices.insert(mesh.indices.end(), {3, 3, 4});
  EXPECT_EQ(plan_grass(grass_ground(mesh), {.strands = 100, .steepest = 180}).growing(), all);
  mesh.normals[0].x = std::numeric_limits<float>::quiet_NaN();
  mesh.positions[24].y = std::numeric_limits<float>::infinity();
  const GrassPlan plan = plan_grass(grass_ground(mesh), {.strands = 100, .steepest = 180});
  EXPECT_EQ(plan.growing(), all - 2);  // each of the two corners has one triangle
  EXPECT_EQ(plan.strands(), 100);
  EXPECT_EQ(plan_grass({}, {.strands = 100}).strands(), 0);
}

TEST(GrassPlan, RefusesWhatCannotGrow) {
  TriangleMesh mesh = meadow(3);
  const auto refused = [&](const GrassGrowth& growth) {
    const Failure failure = failure_of([&] { plan_grass(grass_ground(mesh), growth); });
    EXPECT_EQ(failure.code, ExitCode::kUsage);
    return failure.what;
  };
  EXPECT_THAT(refused({.strands = -1}), HasSubstr("-1"));
  EXPECT_THAT(refused({.strands = GrassGrowth::kMostStrands + 1}), HasSubstr("strands"));
  EXPECT_THAT(refused({.strands = 1, .height = 0}), HasSubstr("size"));
  EXPECT_THAT(refused({.strands = 1, .width = std::nanf("")}), HasSubstr("size"));
  EXPECT_THAT(refused({.strands = 1, .steepest = std::nanf("")}), HasSubstr("size"));
  mesh.indices[4] = 16;
  EXPECT_THAT(refused({.strands = 1}), HasSubstr("16"));
  mesh.indices[4] = 2;
  mesh.normals.pop_back();
  EXPECT_THAT(refused({.strands = 1}), HasSubstr("15 normals"));
}

TEST(GrassTexture, KeepsItsCoverInTheDistance) {
  const std::vector<GrassTexels> levels = paint_grass();
  ASSERT_EQ(levels.size(), 9U);
  EXPECT_EQ(levels.back().side, 1);
  const auto cover = [&](const GrassTexels& level, int layer) {
    const std::size_t texels = static_cast<std::size_t>(level.side) * level.side;
    EXPECT_EQ(level.rgba.size(), 4 * kGrassLayers * texels);
    std::size_t opaque = 0;
    for (std::size_t i = 0; i < texels; ++i) opaque += level.rgba[4 * (layer * texels + i) + 3] > 127 ? 1 : 0;
    return static_cast<double>(opaque) / static_cast<double>(texels);
  };
  for (int layer = 0; layer < kGrassLayers; ++layer) {
    const double share = cover(levels[0], layer);
    EXPECT_GT(share, 0.15);
    EXPECT_LT(share, 0.8);
    for (std::size_t k = 1; k < 5; ++k) EXPECT_NEAR(cover(levels[k], layer), share, 0.05) << k;
  }
}

}  // namespace
}  // namespace terrabench
