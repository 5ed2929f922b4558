#include "terrain/framing.h"

#include <gtest/gtest.h>

namespace terrabench {
namespace {

glm::vec3 projected(const View& view, const glm::vec3& point) {
  const glm::vec4 clip = world_to_clip(view) * glm::vec4(point, 1);
  return glm::vec3(clip) / clip.w;
}

TEST(Framing, APlanHasNorthAtTheTop) {
  EXPECT_EQ(upright({1, -3, 2}), glm::vec3(0, 1, 0));
  EXPECT_EQ(upright({0, -1000, 0}), glm::vec3(0, 0, -1));
  EXPECT_EQ(upright({0, -1, 0}, {1, 0, 0}), glm::vec3(1, 0, 0));
  View view;
  view.eye = {10, 100, 10};
  for (const float up : {-1.0F, 1.0F}) {
    view.target = view.eye + glm::vec3(0, up, 0);
    view.up = upright(view.target - view.eye);
    EXPECT_GT(projected(view, {10, 100 + 50 * up, 10 + 9 * up}).y, 0.1F);
    // Tilted a little towards north, the picture stays as it is.
    View tilted = view;
    tilted.target.z -= 0.01F;
    tilted.up = upright(tilted.target - tilted.eye);
    EXPECT_NE(tilted.up, view.up);
    const glm::vec3 before = projected(view, {14, 100 + 50 * up, 7}),
                    after = projected(tilted, {14, 100 + 50 * up, 7});
    EXPECT_NEAR(before.x, after.x, 0.05);
    EXPECT_NEAR(before.y, after.y, 0.05);
  }
}

TEST(Framing, TheFarPlaneLiesBehindTheBoxFromAnyEye) {
  const Bounds box{{0, -5, 0}, {30, 70, 10}};
  for (const glm::vec3 eye : {glm::vec3(15, 20, 5), {-1000, 3, 4}, {1e6F, 1e6F, -1e6F}, {15, -300, 5}}) {
    View view;
    view.eye = eye;
    view.target = {3, 2, 1};
    view.far = static_cast<float>(far_plane(eye, box));
    const DepthRange range = depth_range(view, box);
    EXPECT_GT(view.far, range.farthest);
    EXPECT_LT(range.nearest, range.farthest);
  }
  View view;  // looks along -z from the origin
  const DepthRange range = depth_range(view, {{-1, -1, -7}, {1, 1, 3}});
  EXPECT_EQ(range.nearest, -3);
  EXPECT_EQ(range.farthest, 7);
}

}  // namespace
}  // namespace terrabench
