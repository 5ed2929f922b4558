#include "terrain/view.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "terrain/source.h"

namespace terrabench {
namespace {

glm::vec3 projected(const View& view, const glm::vec3& point) {
  const glm::vec4 clip = world_to_clip(view) * glm::vec4(point, 1);
  return glm::vec3(clip) / clip.w;
}

TEST(View, TheTargetIsInTheMiddleAndUpIsUp) {
  View view;
  view.eye = {10, 20, 30};
  view.target = {0, 5, 0};
  const glm::vec3 middle = projected(view, view.target);
  EXPECT_NEAR(middle.x, 0, 1e-5);
  EXPECT_NEAR(middle.y, 0, 1e-5);
  EXPECT_GT(projected(view, {0, 6, 0}).y, 0);
  EXPECT_LT(projected(view, {0, 4, 0}).y, 0);
}

TEST(View, NearAndFarAreTheEndsOfDepth) {
  View view;  // looks along -z from the origin
  view.near = 2;
  view.far = 50;
  EXPECT_NEAR(projected(view, {0, 0, -2}).z, -1, 1e-4);
  EXPECT_NEAR(projected(view, {0, 0, -50}).z, 1, 1e-4);
}

TEST(View, OverviewShowsTheWholeBoxAndFillsThePicture) {
  for (const Bounds& box : {Bounds{{0, 0, 0}, {30000, 840, 32000}}, Bounds{{-5, -5, -5}, {5, 5, 5}},
                            Bounds{{0, 0, 0}, {10, 1, 4000}}, Bounds{{3, 3, 3}, {3, 3, 3}}}) {
    for (const auto& [width, height] : {std::pair{800, 600}, {300, 900}}) {
      const View view = overview(box, width, height);
      float reach = 0;
      for (int corner = 0; corner < 8; ++corner) {
        const glm::vec3 at = projected(view, box.corner(corner));
        EXPECT_LE(std::abs(at.x), 1);
        EXPECT_LE(std::abs(at.y), 1);
        EXPECT_LE(std::abs(at.z), 1.001F);  // floats far from the origin round
        reach = std::max({reach, std::abs(at.x), std::abs(at.y)});
      }
      if (box.size() != glm::vec3(0)) {
        EXPECT_GT(reach, 0.75F);
      }
      // From the south-east, above.
      EXPECT_GT(view.eye.x, view.target.x);
      EXPECT_GT(view.eye.y, view.target.y);
      EXPECT_GT(view.eye.z, view.target.z);
    }
  }
}

TEST(TerrainSource, BoundsOfHeightsHaveSubstanceUnderTheLowestSample) {
  TerrainSource source;
  source.heights.emplace();
  source.heights->width = 3;
  source.heights->depth = 2;
  source.heights->cell_x = 10;
  source.heights->cell_z = 30;
  source.heights->heights = {5, 6, 7, Heightfield::kNoData, 9, 8};
  const Bounds bounds = source.bounds();
  EXPECT_EQ(bounds.low, glm::vec3(0, -25, 0));
  EXPECT_EQ(bounds.high, glm::vec3(20, 9, 30));
}

}  // namespace
}  // namespace terrabench
