// Heights from the three nearest points, against a search of all points.

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "lod/mrbsp/nearest_three.h"
#include "lod/mrbsp/subset_triangles.h"
#include "tests/lod/mrbsp_ground.h"
#include "tests/terrain/errors.h"

namespace terrabench {
namespace {

std::vector<glm::vec3> scattered(int count) {
  std::vector<glm::vec3> points;
  for (int k = 0; k < count; ++k) {
    const auto key = static_cast<std::uint32_t>(3 * k);
    points.emplace_back(100 * random_share(key), 50 * random_share(key + 1), 80 * random_share(key + 2));
  }
  return points;
}

// The three nearest points by sorting, and the nearest place of their triangle by trying many places.
float by_search(std::vector<glm::vec3> points, float x, float z) {
  std::stable_sort(points.begin(), points.end(), [&](const glm::vec3& a, const glm::vec3& b) {
    return std::hypot(a.x - x, a.z - z) < std::hypot(b.x - x, b.z - z);
  });
  constexpr int kSteps = 400;
  float best = std::numeric_limits<float>::infinity(), height = 0;
  for (int a = 0; a <= kSteps; ++a) {
    for (int b = 0; a + b <= kSteps; ++b) {
      const float s = static_cast<float>(a) / kSteps, t = static_cast<float>(b) / kSteps;
      const glm::vec3 p = points[0] * (1 - s - t) + points[1] * s + points[2] * t;
      const float off = std::hypot(p.x - x, p.z - z);
      if (off < best) {
        best = off;
        height = p.y;
      }
    }
  }
  return height;
}

TEST(NearestThree, IsTheNearestPlaceOfTheThreeNearestPoints) {
  const auto points = scattered(150);
  const NearestThree nearest(points);
  for (std::uint32_t k = 0; k < 60; ++k) {
    // Includes positions outside the points' rectangle.
    const float x = 160 * random_share(9000 + 2 * k) - 30, z = 140 * random_share(9001 + 2 * k) - 30;
    EXPECT_NEAR(nearest.height(x, z), by_search(points, x, z), 0.5F) << x << ", " << z;
  }
}

TEST(NearestThree, FindsTheVeryPointItStandsOn) {
  const auto points = scattered(500);
  const NearestThree nearest(points);
  for (const glm::vec3& p : points) EXPECT_EQ(nearest.height(p.x, p.z), p.y);
}

TEST(NearestThree, AFewPointsOrALineOfThemGiveWhatTheyCan) {
  EXPECT_EQ(NearestThree(std::vector<glm::vec3>{{3, 7, 3}}).height(100, -5), 7);
  const std::vector<glm::vec3> two{{0, 0, 0}, {10, 10, 0}};
  EXPECT_FLOAT_EQ(NearestThree(two).height(2.5F, 4), 2.5F);
  EXPECT_EQ(NearestThree(two).height(-3, 1), 0);
  const std::vector<glm::vec3> line{{0, 0, 0}, {10, 10, 0}, {20, 0, 0}, {30, 50, 0}};
  EXPECT_FLOAT_EQ(NearestThree(line).height(7, 1), 7);
  const std::vector<glm::vec3> same(5, glm::vec3(1, 4, 1));
  EXPECT_EQ(NearestThree(same).height(2, 2), 4);
  EXPECT_EQ(failure_of([] { NearestThree(std::vector<glm::vec3>{}); }).code, ExitCode::kUsage);
}

TEST(InterpolateHeights, OnItsOwnGridTheSamplesComeBack) {
  const Heightfield field = rough_ground(33, 33);
  const Heightfield heights = interpolate_heights(height_points(field), BisectionTree(5, 11), silent());
  EXPECT_EQ(heights.width, 33);
  EXPECT_EQ(heights.cell_x, field.cell_x);
  EXPECT_EQ(heights.heights, field.heights);
}

TEST(InterpolateHeights, IsTheSameForAnyNumberOfThreadsAndWithinThePoints) {
  const auto points = scattered(3000);
  const Heightfield many = interpolate_heights(points, BisectionTree(6, 13), silent());
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  EXPECT_EQ(interpolate_heights(points, BisectionTree(6, 13), silent()).heights, many.heights);
  const HeightRange range = height_range(many);
  EXPECT_GE(range.lowest, 0);
  EXPECT_LE(range.highest, 50);
}

TEST(InterpolateHeights, RefusesPointsInALine) {
  const std::vector<glm::vec3> line{{0, 0, 0}, {10, 10, 0}};
  EXPECT_EQ(failure_of([&] { (void)interpolate_heights(line, BisectionTree(2, 5), silent()); }).code,
            ExitCode::kUsage);
}

TEST(InterpolateSubsets, TearsVerticesWhereAllPointsWouldNot) {
  const Heightfield field = rough_ground(33, 33);
  const auto points = height_points(field);
  const BisectionTree tree(5, 9);  // 512 triangles with about two points each, corners on every other sample
  const SubsetTriangles torn = interpolate_subsets(points, tree, false);
  ASSERT_EQ(torn.corners.size(), 3 * tree.triangles());
  const VertexGaps gaps = vertex_gaps(torn);
  EXPECT_EQ(gaps.vertices, tree.vertices());
  EXPECT_GT(gaps.torn, gaps.vertices / 2);
  EXPECT_GT(gaps.largest, 5);
  // If points on a divider belong to both halves, points on vertices leave no vertex torn.
  const VertexGaps shared = vertex_gaps(interpolate_subsets(points, tree, true));
  EXPECT_EQ(shared.vertices, tree.vertices());
  EXPECT_EQ(shared.torn, 0U);
  EXPECT_EQ(shared.largest, 0);
}

TEST(InterpolateSubsets, StarvedTrianglesFallBackToTheirParents) {
  // Two points at sea level on the diagonal and a higher one in the first half of the square: triangles
  // without points take their parent's plane.
  const std::vector<glm::vec3> points{{0, 0, 0}, {8, 0, 8}, {7, 6, 1}};
  const SubsetTriangles triangles = interpolate_subsets(points, BisectionTree(2, 3), true);
  EXPECT_GT(triangles.starved, 0U);
  const auto [low, high] = std::minmax_element(triangles.corners.begin(), triangles.corners.end(),
                                               [](const auto& a, const auto& b) { return a.y < b.y; });
  EXPECT_GE(low->y, 0);
  EXPECT_LE(high->y, 6);
  EXPECT_GT(high->y, 0);
}

}  // namespace
}  // namespace terrabench
