// The eye keeps above the ground in every motion, and looks where it should.
#include "viewer/camera.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "lod/camera/camera_path.h"
#include "terrain/framing.h"
#include "tests/terrain/ground.h"
#include "viewer/pick.h"

namespace terrabench::viewer {
namespace {

struct OnHills {
  Heightfield ground = test::ground_of(
      101, 81, [](int i, int j) { return 200 * std::sin(0.1 * i) * std::cos(0.13 * j); }, 30, 30);
  Bounds bounds = bounds_of(ground);
  Camera camera;
  OnHills() { camera.stand_on(ground, bounds); }
  double above() const { return camera.eye().y - ground_under(ground, {camera.eye().x, camera.eye().z}); }
};

TEST(Camera, BeginsWithGroundInView) {
  const OnHills on;
  EXPECT_GT(on.above(), 1.79);
  const View view = on.camera.view(800, 600);
  EXPECT_NO_THROW(check_view(view));
  EXPECT_TRUE(pick(on.ground, view, {400, 500}));
}

TEST(Camera, KeepsAboveTheGroundInEveryMotion) {
  for (const Motion motion : {Motion::kFly, Motion::kWalk, Motion::kOrbit, Motion::kPlan}) {
    OnHills on;
    on.camera.set_motion(motion);
    for (int k = 0; k < 400; ++k) {
      on.camera.turn(3 * std::sin(0.1 * k), std::cos(0.07 * k));
      on.camera.move({0.3, -0.5, 1}, 0.05);
      EXPECT_GE(on.above(), 1.8 - 1e-6) << static_cast<int>(motion) << " " << k;
      if (motion == Motion::kWalk) {
        EXPECT_NEAR(on.above(), 1.8, 1e-6) << k;
      }
      EXPECT_NO_THROW(check_view(on.camera.view(800, 600)));
    }
  }
}

TEST(Camera, AWalkIgnoresPitchAndFlightFollowsIt) {
  OnHills on;
  on.camera.place({1500, 900, 1200}, 90, 30);
  on.camera.set_speed(10);
  on.camera.move({0, 0, 1}, 1);
  EXPECT_NEAR(on.camera.eye().x, 1500 + 10 * std::cos(0.5236), 1e-3);
  EXPECT_NEAR(on.camera.eye().y, 905, 1e-3);
  on.camera.set_motion(Motion::kWalk);
  const double before = on.camera.eye().x;
  on.camera.move({0, 0, 1}, 1);
  EXPECT_NEAR(on.camera.eye().x, before + 10, 1e-9);
}

TEST(Camera, AnOrbitKeepsItsPlaceAndDistance) {
  OnHills on;
  on.camera.place({1500, 1500, 2300}, 0, -40);
  const auto place = pick(on.ground, on.camera.view(800, 600), {400, 300});
  ASSERT_TRUE(place);
  on.camera.set_motion(Motion::kOrbit);
  const double away = glm::distance(on.camera.eye(), *place);
  on.camera.turn(70, -10);
  EXPECT_NEAR(glm::distance(on.camera.eye(), *place), away, 1);
  const auto still = pick(on.ground, on.camera.view(800, 600), {400, 300});
  ASSERT_TRUE(still);
  EXPECT_LT(glm::distance(*still, *place), 10);
  on.camera.zoom(2);
  EXPECT_NEAR(glm::distance(on.camera.eye(), *place), away / 1.44, 1);
}

TEST(Camera, APlanHasItsHeadingAtTheTop) {
  OnHills on;
  on.camera.set_motion(Motion::kPlan);
  on.camera.place({1500, 3000, 1200}, 90, 0);
  const View view = on.camera.view(800, 600);
  EXPECT_NEAR(view.up.x, 1, 1e-6);
  EXPECT_EQ(view.target.x, view.eye.x);
  EXPECT_EQ(view.target.z, view.eye.z);
  EXPECT_LT(view.target.y, view.eye.y);
}

TEST(Camera, TakesOverAView) {
  OnHills on;
  View view;
  view.eye = {500, 800, 500};
  view.target = {900, 700, 900};
  view.vertical_fov = 1;
  on.camera.take(view);
  const View taken = on.camera.view(800, 600);
  EXPECT_LT(glm::distance(taken.eye, view.eye), 1e-3F);
  const glm::vec3 a = glm::normalize(view.target - view.eye), b = glm::normalize(taken.target - taken.eye);
  EXPECT_GT(glm::dot(a, b), 1 - 1e-6F);
  EXPECT_NEAR(taken.vertical_fov, 1, 1e-6);
}

TEST(Pick, FindsTheGroundThatAPixelShows) {
  const OnHills on;
  const auto at = pick(on.ground, {1500, 1000, 1200}, {0, -1, 0});
  ASSERT_TRUE(at);
  EXPECT_NEAR(at->y, on.ground.sample(1500, 1200), 1e-3);
  const auto slanted = pick(on.ground, {10, 400, 10}, {1, -0.2, 0.7});
  ASSERT_TRUE(slanted);
  EXPECT_NEAR(slanted->y, on.ground.sample(static_cast<float>(slanted->x), static_cast<float>(slanted->z)),
              1e-2);
  EXPECT_FALSE(pick(on.ground, {10, 400, 10}, {1, 0.2, 0.7}));    // sky
  EXPECT_FALSE(pick(on.ground, {-10, 400, 10}, {-1, -1, 0.7}));   // beside
  EXPECT_FALSE(pick(on.ground, {10, -900, 10}, {1, -0.2, 0.7}));  // from below
}

}  // namespace
}  // namespace terrabench::viewer
