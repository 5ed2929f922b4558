// What ROAM promises of error and cracks, over fields and views of all kinds, from scratch and frame by
// frame.
#include "lod/roam/roam.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "lod/camera/camera_path.h"
#include "tests/lod/roam_audit.h"
#include "tests/lod/roam_ground.h"

namespace terrabench::test {
namespace {

TEST(Roam, KeepsItsErrorFromAnyView) {
  std::mt19937 random(7);
  double closest = 0;
  for (const auto& [width, depth] : kSizes) {
    const Heightfield field = ground(width, depth);
    Roam roam(field, {.max_error = 2}, silent());
    for (int k = 0; k < 12; ++k) {
      SCOPED_TRACE(::testing::Message() << width << " x " << depth << ", view " << k);
      const View view = random_view(field, random);
      closest = std::max(closest, expect_kept(roam, roam.update(view), field, view, 2) / 2);
    }
  }
  EXPECT_GT(closest, 0.9);  // the bound is not met by drawing more than necessary
}

TEST(Roam, KeepsItsErrorOnHighGround) {
  std::mt19937 random(19);
  Heightfield field = ground(129, 65);
  for (float& height : field.heights) height += 3000;
  Roam roam(field, {.max_error = 0.5}, silent());
  for (int k = 0; k < 12; ++k) {
    SCOPED_TRACE(::testing::Message() << "view " << k);
    View view = random_view(field, random);
    view.eye.y += 3000;
    view.target.y += 3000;
    expect_kept(roam, roam.update(view), field, view, 0.5);
  }
}

// ROAM's tolerance for rounding, and so what it culls, depends on the ground's extent.
TEST(Roam, KnowsTheExtentOfEditedGround) {
  Heightfield field = ground(33, 21);
  Roam roam(field, {.max_error = 1}, silent());
  struct Edit {
    glm::ivec2 at;
    float height;
  };
  for (const Edit& edit : {Edit{{4, 5}, 5000},
                           {{20, 11}, -7000},
                           {{4, 5}, 0},
                           {{20, 11}, 10},
                           {{32, 20}, 10},
                           {{0, 0}, 6000},
                           {{30, 1}, 6000},
                           {{0, 0}, 1},
                           {{30, 1}, 1}}) {
    SCOPED_TRACE(::testing::Message() << edit.at.x << ", " << edit.at.y << ": " << edit.height);
    field.at(edit.at.x, edit.at.y) = edit.height;
    roam.edited({edit.at, edit.at});
    EXPECT_EQ(RoamAudit::extent(roam), RoamAudit::extent(Roam(field, {.max_error = 1}, silent())));
  }
  // The largest absolute height inside a larger rectangle; then that height is removed, and the largest lies
  // outside the rectangle.
  field.at(30, 1) = 6000;
  roam.edited({{30, 1}, {30, 1}});
  for (const float height : {-9000.0F, 0.0F}) {
    SCOPED_TRACE(height);
    field.at(13, 9) = height;
    roam.edited({{8, 6}, {20, 15}});
    EXPECT_EQ(RoamAudit::extent(roam), RoamAudit::extent(Roam(field, {.max_error = 1}, silent())));
    EXPECT_GT(RoamAudit::extent(roam), std::max(6000.0F, std::abs(height)));
  }
}

TEST(Roam, IsExactWhereNoErrorIsAllowed) {
  for (const auto& [width, depth] : kSizes) {
    SCOPED_TRACE(::testing::Message() << width << " x " << depth);
    const Heightfield field = ground(width, depth);
    Roam roam(field, {.max_error = 1e-3}, silent());
    const View view = from_above(field);
    const Frame& frame = roam.update(view);
    expect_kept(roam, frame, field, view, 1e-3);
    EXPECT_NEAR(plan_area(frame), plan_area(field), 1e-6 * plan_area(field));
  }
}

TEST(Roam, KeepsItsErrorAlongPaths) {
  for (const auto& [width, depth] : {Sizes{129, 129}, {150, 201}}) {
    const Heightfield field = ground(width, depth, 0.3F);
    double closest = 0;
    for (const CameraPath& path : camera_paths()) {
      Roam roam(field, {.max_error = 3}, silent());
      const std::vector<View> frames = views(path, field);
      const std::size_t step = std::max<std::size_t>(frames.size() / 10, 1);
      for (std::size_t k = 0; k < frames.size(); ++k) {
        const Frame& frame = roam.update(frames[k]);
        if (k % step != 0) continue;
        SCOPED_TRACE(::testing::Message() << path.name << ", frame " << k);
        closest = std::max(closest, expect_kept(roam, frame, field, frames[k], 3) / 3);
      }
    }
    EXPECT_GT(closest, 0.9);
  }
}

// The mesh that remains from earlier views has at most a few triangles more than one built from scratch.
TEST(Roam, AMovingCameraGetsNearlyTheMeshBuiltFromScratch) {
  const Heightfield field = ground(150, 201, 0.5F);
  std::mt19937 random(3);
  Roam warm(field, {.max_error = 1}, silent());
  for (int k = 0; k < 20; ++k) {
    View view = random_view(field, random);
    warm.update(view);
    for (int step = 0; step < 30; ++step) {
      view.eye.x += 0.2F;
      view.target += glm::vec3(0.2F, 0.001F, 0.01F);
      warm.update(view);
    }
    const std::size_t kept = warm.update(view).stats.triangles;
    const std::size_t from_scratch = Roam(field, {.max_error = 1}, silent()).update(view).stats.triangles;
    EXPECT_GE(kept, from_scratch);
    EXPECT_LE(static_cast<double>(kept), 1.1 * static_cast<double>(from_scratch) + 20);
  }
}

TEST(Roam, FollowsItsKnob) {
  const Heightfield field = ground(129, 129);
  View view;
  view.eye = {190, 30, 250};
  view.target = {190, 5, 0};
  Roam roam(field, {.max_error = 1}, silent());
  const std::size_t fine = roam.update(view).stats.triangles;
  roam.tune(8);
  const Frame& coarse = roam.update(view);
  expect_kept(roam, coarse, field, view, 8);
  EXPECT_LT(coarse.stats.triangles, fine / 2);
  roam.tune(1);
  EXPECT_EQ(roam.update(view).stats.triangles, fine);
}

TEST(Roam, TurnsOnTheSpot) {
  const Heightfield field = ground(150, 201);
  Roam roam(field, {.max_error = 2}, silent());
  View view;
  view.eye = {200, 20, 190};
  std::size_t first = 0;
  for (int degrees = 0; degrees <= 360; degrees += 5) {
    const float angle = static_cast<float>(degrees) * 0.0174532925F;
    view.target = view.eye + glm::vec3(std::cos(angle), -0.1F, std::sin(angle));
    const Frame& frame = roam.update(view);
    if (degrees == 0) first = frame.stats.triangles;
    if (degrees % 30 == 0) expect_kept(roam, frame, field, view, 2);
    if (degrees < 360) continue;
    EXPECT_NEAR(static_cast<double>(frame.stats.triangles), first, 0.05 * first);
  }
}

// The far plane may follow the ground, alone or while the eye moves.
TEST(Roam, FollowsAFarPlaneThatMoves) {
  const Heightfield field = ground(150, 201);
  for (const float step : {0.0F, 0.5F}) {
    Roam roam(field, {.max_error = 2}, silent());
    View view;
    view.eye = {200, 20, 390};
    view.target = {200, 15, 0};
    view.far = 500;
    const std::size_t all = roam.update(view).stats.triangles;
    std::size_t fewest = all;
    for (int k = 0; k < 60; ++k) {
      SCOPED_TRACE(::testing::Message() << step << " m per frame, frame " << k);
      view.far += k < 30 ? -14.0F : 14.0F;
      view.eye.z -= step;
      const Frame& frame = roam.update(view);
      fewest = std::min(fewest, frame.stats.triangles);
      if (k % 10 == 9) expect_kept(roam, frame, field, view, 2);
    }
    EXPECT_LT(fewest, all / 2);
    if (step == 0) {
      EXPECT_EQ(roam.update(view).stats.triangles, all);
    }
  }
}

TEST(Roam, TakesAnyView) {
  const Heightfield field = ground(150, 201);
  Roam roam(field, {.max_error = 2, .triangles = 20000}, silent());
  const auto take = [&](auto change) {
    View view;
    view.eye = {200, 40, 190};
    view.target = {100, 0, 50};
    change(view);
    roam.update(view);
    EXPECT_EQ(RoamAudit::first_problem(roam), "");
  };
  take([](View&) {});
  take([](View& v) { v.eye.y = -500; });
  take([](View& v) { v.eye = {-1e5F, 3, 1e5F}; });
  take([](View& v) { v.eye.y = 1e30F, v.up = {0, 0, -1}; });
  take([](View& v) { v.eye = glm::vec3(-3e38F), v.target = glm::vec3(3e38F); });
  take([](View& v) { v.width = v.height = 1; });
  take([](View& v) { v.width = 100000, v.height = 1; });
  take([](View& v) { v.vertical_fov = 1e-6F; });
  take([](View& v) { v.vertical_fov = 3.14159F; });
  take([](View& v) { v.up = {0, -1, 0}; });
  take([](View& v) { v.up = {0, 0, -1e-20F}, v.target = v.eye - glm::vec3(0, 1, 0); });
  take([](View& v) { v.near = 1e-6F, v.far = 1e30F; });
  take([](View& v) { v.near = 100, v.far = 101; });
  take([](View&) {});
}

TEST(Roam, AcceptsTheLargestFloatHeights) {
  Heightfield field = ground(20, 20);
  field.at(3, 3) = std::numeric_limits<float>::max();
  field.at(4, 4) = std::numeric_limits<float>::lowest();
  Roam roam(field, {}, silent());
  roam.update(from_above(ground(20, 20)));
  EXPECT_EQ(RoamAudit::first_problem(roam), "");
}

TEST(Roam, IsBuiltByName) {
  const Heightfield field = ground(40, 30);
  Parameters parameters(lod("roam").parameters);
  parameters.set("triangles", std::int64_t{300});
  const std::unique_ptr<Lod> roam = lod("roam").build(field, parameters, silent());
  EXPECT_GT(roam->update(from_above(field)).stats.triangles, 0U);
}

}  // namespace
}  // namespace terrabench::test
