#include "terrain/hydrology/steepest.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "tests/terrain/ground.h"

namespace terrabench {
namespace {

// The index in kFlowSteps of a step.
int direction(int x, int z) {
  for (int d = 0; d < 8; ++d) {
    if (kFlowSteps[static_cast<std::size_t>(d)].x == x && kFlowSteps[static_cast<std::size_t>(d)].z == z)
      return d;
  }
  return -1;
}

TEST(SteepestDescent, TakesTheLargestFallPerMetreAndStopsInPits) {
  // 5 → 3 falls by 2 over one cell; 5 → 2.5 by 2.5 over a diagonal, which is less per metre.
  const float heights[] = {9, 9, 9,    9,  //
                           9, 5, 3,    9,  //
                           9, 9, 2.5F, 1};
  const Heightfield field = test::ground_of(4, 3, [&](int i, int j) { return heights[4 * j + i]; });
  const FlowNetwork network = route_steepest(field);
  EXPECT_EQ(network.direction[5], direction(1, 0));   // to the 3
  EXPECT_EQ(network.direction[6], direction(1, 1));   // 3 → 1: 1.41 per metre, against 0.5 to the 2.5
  EXPECT_EQ(network.direction[10], direction(1, 0));  // 2.5 → 1
  EXPECT_EQ(network.direction[11], FlowNetwork::kOutlet);
  EXPECT_EQ(network.accumulation[11], 12U);
}

TEST(SteepestDescent, PitsAndFlatsKeepTheirFlow) {
  Heightfield field = test::flat(7, 7, 5);
  field.at(3, 3) = 1;
  const FlowNetwork network = route_steepest(field);
  EXPECT_EQ(network.accumulation[24], 9U);  // the pit and its eight neighbours
  EXPECT_EQ(network.direction[24], FlowNetwork::kOutlet);
  EXPECT_EQ(network.direction[0], FlowNetwork::kOutlet);
  EXPECT_EQ(network.accumulation[0], 1U);
}

// On any ground: each pixel drains to its steepest lower neighbour, and the outlets take all flow.
TEST(SteepestDescent, AgreesWithTheDefinitionOnGroundWithHolesAndLongCells) {
  Heightfield field = test::with_holes(test::random_ground(60, 45, 3, 0, 90, 2, 5), 4, 0.05);
  const FlowNetwork network = route_steepest(field);
  std::size_t pixels = 0, drained = 0;
  for (int j = 0; j < field.depth; ++j) {
    for (int i = 0; i < field.width; ++i) {
      const auto at = static_cast<std::size_t>(j * field.width + i);
      if (Heightfield::is_no_data(field.at(i, j))) {
        EXPECT_EQ(network.direction[at], FlowNetwork::kNoData);
        EXPECT_EQ(network.accumulation[at], 0U);
        continue;
      }
      ++pixels;
      double most = 0;
      int best = FlowNetwork::kOutlet;
      for (int z = -1; z <= 1; ++z) {
        for (int x = -1; x <= 1; ++x) {
          if (i + x < 0 || j + z < 0 || i + x >= field.width || j + z >= field.depth || (x == 0 && z == 0))
            continue;
          const float other = field.at(i + x, j + z);
          if (Heightfield::is_no_data(other)) continue;
          const double fall = (field.at(i, j) - other) / std::hypot(2 * x, 5 * z);
          if (fall > most) {
            most = fall;
            best = direction(x, z);
          }
        }
      }
      EXPECT_EQ(network.direction[at], best) << i << " " << j;
      if (best == FlowNetwork::kOutlet) drained += network.accumulation[at];
    }
  }
  EXPECT_EQ(drained, pixels);
}

}  // namespace
}  // namespace terrabench
