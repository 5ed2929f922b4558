// The implicit tree against triangles split one by one.
#include "lod/mrbsp/bisection_tree.h"

#include <gtest/gtest.h>

#include <map>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

#include "tests/terrain/errors.h"

namespace terrabench {
namespace {

using Place = std::pair<int, int>;
Place key(glm::ivec2 at) { return {at.x, at.y}; }

long long doubled_area(const PlanTriangle& t) {
  const glm::ivec2 u = t.left - t.apex, v = t.right - t.apex;
  return static_cast<long long>(u.y) * v.x - static_cast<long long>(u.x) * v.y;
}

// All triangles of a depth, split as the paper says, in the order of their numbers.
std::vector<PlanTriangle> bisect(const BisectionTree& tree, int depth) {
  const auto roots = tree.roots();
  std::vector<PlanTriangle> level(roots.begin(), roots.end());
  for (int d = 1; d < depth; ++d) {
    std::vector<PlanTriangle> next;
    for (const PlanTriangle& t : level) {
      const glm::ivec2 centre = (t.left + t.right) / 2;
      next.push_back({centre, t.apex, t.left});
      next.push_back({centre, t.right, t.apex});
    }
    level = next;
  }
  return level;
}

TEST(BisectionTree, ThePapersLandscapeHasItsTriangles) {
  const BisectionTree tree(8, 16);
  EXPECT_EQ(tree.triangles(), 65536U);
  EXPECT_EQ(tree.vertices(), 33025U);
  EXPECT_EQ(tree.side(), 256);
  EXPECT_EQ(tree.square_at(16), 2);
  EXPECT_EQ(BisectionTree(8, 17).vertices(), 257U * 257U);
  EXPECT_EQ(BisectionTree::over(257, 257).depth(), 17);
  EXPECT_EQ(BisectionTree::over(403, 344).side(), 512);
  EXPECT_EQ(BisectionTree::over(2, 2).depth(), 1);
}

TEST(BisectionTree, NumbersLeadToTheBisectedTriangles) {
  const BisectionTree tree(4, 9);
  for (int depth = 1; depth <= 9; ++depth) {
    const auto level = bisect(tree, depth);
    ASSERT_EQ(level.size(), std::size_t{1} << depth);
    for (std::size_t k = 0; k < level.size(); ++k) {
      const NodeNumber node = first_node(depth) + k;
      EXPECT_EQ(tree.triangle(node), level[k]);
      EXPECT_EQ(depth_of(node), depth);
    }
  }
}

TEST(BisectionTree, EveryDepthIsRightAngledEqualAndCounterClockwise) {
  const BisectionTree tree(4, 9);
  for (int depth = 1; depth <= 9; ++depth) {
    long long sum = 0;
    std::set<Place> corners;
    for (const PlanTriangle& t : bisect(tree, depth)) {
      const glm::ivec2 u = t.left - t.apex, v = t.right - t.apex;
      EXPECT_EQ(u.x * v.x + u.y * v.y, 0);
      EXPECT_EQ(u.x * u.x + u.y * u.y, v.x * v.x + v.y * v.y);
      EXPECT_EQ(doubled_area(t), 2LL * 16 * 16 >> depth);
      sum += doubled_area(t);
      for (const glm::ivec2 at : {t.apex, t.left, t.right}) corners.insert(key(at));
    }
    EXPECT_EQ(sum, 2LL * 16 * 16);
    const BisectionTree shallow(4, depth);
    EXPECT_EQ(corners.size(), shallow.vertices());
  }
}

// A vertex's parents, against all triangles that it splits.
TEST(BisectionTree, ParentsAreTheRightAnglesOfTheTrianglesSplit) {
  const BisectionTree tree(4, 9);
  std::map<Place, std::set<Place>> splits;
  for (int depth = 1; depth < 9; ++depth) {
    for (const PlanTriangle& t : bisect(tree, depth)) {
      std::set<Place>& parents = splits[key((t.left + t.right) / 2)];
      if (depth > 1) parents.insert(key(t.apex));
    }
  }
  EXPECT_EQ(splits.size(), 17U * 17 - 4);
  for (const auto& [at, expected] : splits) {
    const glm::ivec2 vertex(at.first, at.second);
    const auto parents = tree.parents(vertex);
    std::set<Place> found;
    for (int k = 0; k < parents.count; ++k) found.insert(key(parents.at[k]));
    EXPECT_EQ(found, expected) << at.first << ", " << at.second;
  }
  for (const glm::ivec2 corner : {glm::ivec2(0, 0), {16, 0}, {0, 16}, {16, 16}}) {
    EXPECT_EQ(tree.parents(corner).count, 0);
  }
}

TEST(BisectionTree, LabelsAreThePapersNumbers) {
  EXPECT_EQ(label(0b111), "11");
  EXPECT_EQ(label(0b11100), "1100");
  NodeNumber node = 0;
  EXPECT_TRUE(parse_label("1100", node));
  EXPECT_EQ(node, 0b11100U);
  EXPECT_FALSE(parse_label("", node));
  EXPECT_FALSE(parse_label("12", node));
  EXPECT_FALSE(parse_label(std::string(32, '0'), node));
}

TEST(BisectionTree, RefusesWhatHasNoRoom) {
  EXPECT_EQ(failure_of([] { BisectionTree(3, 8); }).code, ExitCode::kUsage);
  EXPECT_EQ(failure_of([] { BisectionTree(3, 0); }).code, ExitCode::kUsage);
  EXPECT_EQ(failure_of([] { BisectionTree(16, 1); }).code, ExitCode::kUsage);
  EXPECT_EQ(failure_of([] { BisectionTree::over(40000, 2); }).code, ExitCode::kUsage);
}

TEST(BisectionTree, TheSurfaceIsThatOfTheFinestTriangles) {
  for (const int depth : {1, 6, 7, 8, 9}) {
    const BisectionTree tree(4, depth);
    std::vector<float> heights;
    for (int j = 0; j < 17; ++j) {
      for (int i = 0; i < 17; ++i) heights.push_back(static_cast<float>((i * 37 + j * 101) % 23));
    }
    const GroundGrid grid{17, 17, 3.0F, 2.0F, heights};
    for (NodeNumber node = tree.triangles(); node < 2 * tree.triangles(); ++node) {
      const PlanTriangle t = tree.triangle(node);
      float mean = 0;
      glm::vec2 middle(0);
      for (const glm::ivec2 at : {t.apex, t.left, t.right}) {
        const float height = heights[static_cast<std::size_t>(at.y) * 17 + at.x];
        EXPECT_NEAR(surface_height(tree, grid, 3.0F * at.x, 2.0F * at.y), height, 1e-4);
        mean += height / 3;
        middle += glm::vec2(at) / 3.0F;
      }
      EXPECT_NEAR(surface_height(tree, grid, 3 * middle.x, 2 * middle.y), mean, 1e-3);
    }
  }
}

TEST(BisectionTree, TheSurfaceAtFarBordersIsNeverTooLow) {
  // 10 × 7 samples in a square of 17 × 17: triangles that extend beyond the field have the height of their
  // highest corner.
  std::vector<float> heights;
  for (int k = 0; k < 70; ++k) heights.push_back(static_cast<float>((k * 37) % 23));
  const GroundGrid grid{10, 7, 1, 1, heights};
  const BisectionTree tree(4, 9);
  for (int j = 0; j < 7; ++j) {
    for (int i = 0; i < 10; ++i) {
      EXPECT_GE(surface_height(tree, grid, static_cast<float>(i), static_cast<float>(j)),
                heights[static_cast<std::size_t>(j) * 10 + i]);
    }
  }
}

}  // namespace
}  // namespace terrabench
