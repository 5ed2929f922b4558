// The reference method draws every triangle in view once.
#include "lod/brute_force/brute_force.h"

#include <gtest/gtest.h>

#include "tests/lod/drawing.h"

namespace terrabench {
namespace {

TEST(BruteForce, DrawsEveryTriangleOfAnySize) {
  for (const auto& [width, depth] : {std::pair{2, 2}, {33, 33}, {34, 65}, {100, 37}}) {
    const Heightfield field = test::hilly(width, depth);
    BruteForce lod(field);
    EXPECT_EQ(lod.update(test::from_above(field)).stats.triangles,
              std::size_t{2} * (width - 1) * (depth - 1));
  }
}

TEST(BruteForce, LeavesOutBlocksBehindTheEye) {
  const Heightfield field = test::hilly(129, 129, 0, 1, 2, 3);
  BruteForce lod(field);
  View view;
  view.eye = {128, 10, 192};
  view.target = {128, 10, 0};
  const std::size_t ahead = lod.update(view).stats.triangles;
  EXPECT_GT(ahead, 0U);
  EXPECT_LT(ahead, std::size_t{2} * 128 * 128 * 2 / 3);
}

}  // namespace
}  // namespace terrabench
