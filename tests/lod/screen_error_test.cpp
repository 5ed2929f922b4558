// Errors and popping in pixels against the pinhole formula, and the choice of samples.
#include "lod/meters/screen_error.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <glm/geometric.hpp>

#include "lod/brute_force/brute_force.h"
#include "lod/meters/drawn_surface.h"
#include "tests/lod/drawing.h"

namespace terrabench::test {
namespace {

// A level view from 40 m south of the field and 3 m up.
View level_view(const Heightfield& field) {
  View view;
  view.eye = {0.5F * field.extent_x(), 3, field.extent_z() + 40};
  view.target = view.eye - glm::vec3(0, 0, 1);
  return view;
}

double focal(const View& view) { return 0.5 * view.height / std::tan(0.5 * view.vertical_fov); }

TEST(Projector, MeasuresAsAPinholeDoes) {
  const View view;  // looks north from the origin
  const Projector project(view);
  EXPECT_NEAR(project.pixels_between({0, 0, -10}, {0, 1, -10}), focal(view) / 10, 1e-9);
  EXPECT_NEAR(project({0, 0, -10}).x, 400, 1e-9);
  EXPECT_NEAR(project({0, 0, -10}).y, 300, 1e-9);
  EXPECT_LT(project({0, 1, -10}).y, 300);
  EXPECT_GT(project({1, 0, -10}).x, 400);
  EXPECT_NEAR(project({3, 0, -10}).depth, 10, 1e-9);
  EXPECT_TRUE(project.in_view(project({0, 0, -10})));
  EXPECT_FALSE(project.in_view(project({0, 0, 10})));
  EXPECT_FALSE(project.in_view(project({30, 0, -10})));
  EXPECT_FALSE(project.in_view(project({0, 0, -0.1})));
}

TEST(Projector, CutsAtTheNearPlane) {
  View view;
  view.near = 2;
  const Projector project(view);
  EXPECT_EQ(project.pixels_between({0, 0, -1}, {0, 1, 4}), 0);
  // Half of the segment is in front of the near plane.
  EXPECT_NEAR(project.pixels_between({0, 0, -3}, {0, 2, -1}), project.pixels_between({0, 0, -3}, {0, 1, -2}),
              1e-9);
}

TEST(Projector, AgreesWithTheRenderersMatrix) {
  View view;
  view.eye = {10, 20, 30};
  view.target = {-40, 5, -60};
  const glm::vec4 clip = world_to_clip(view) * glm::vec4(-30, 0, -50, 1);
  const ScreenPoint at = Projector(view)({-30, 0, -50});
  EXPECT_NEAR(at.x, (clip.x / clip.w + 1) * 400, 1e-2);
  EXPECT_NEAR(at.y, (1 - clip.y / clip.w) * 300, 1e-2);
  EXPECT_NEAR(at.depth, clip.w, 1e-3);
}

TEST(ScreenError, IsTheProjectedHeightOfWhatIsMissing) {
  Heightfield field = flat(17, 17);
  field.at(8, 4) = 2;
  Drawing drawing(field);
  drawing.square(0, 0, 16);
  const View view = level_view(field);
  const SeenSamples seen(field, view);
  const ScreenDeviation error = screen_error(SurfaceRaster(drawing.frame(), 17, 17), field, seen);
  const double expected = focal(view) * 2 / (40 + 12);
  EXPECT_NEAR(error.visible.largest, expected, 1e-4);
  EXPECT_EQ(error.visible.undrawn, 0U);
  EXPECT_NEAR(error.visible.mean, expected / static_cast<double>(error.visible.samples), 1e-6);
  EXPECT_EQ(error.visible.p99, 0);  // one of more than a hundred
  EXPECT_GT(error.visible.samples, 100U);
  EXPECT_GE(error.in_frustum.samples, error.visible.samples);
}

TEST(ScreenError, NinetyNinePercentDeviateByNoMoreThanP99) {
  // 200 samples in a row, equally far from a level eye: all errors differ.
  Heightfield field = flat(200, 2);
  for (int i = 0; i < 200; ++i) field.at(i, 0) = 0.01F * static_cast<float>(i);
  Drawing drawing(field);
  drawing.triangle({0, 0}, {0, 1}, {199, 1});
  drawing.triangle({0, 0}, {199, 1}, {199, 0});
  Heightfield ground = field;
  for (int i = 0; i < 200; ++i) ground.at(i, 0) = 0.01F * static_cast<float>(i) + static_cast<float>(i % 100);
  for (int i = 0; i < 200; ++i) ground.at(i, 1) = 0;
  View view;
  view.eye = {99.5F, 30, 400};
  view.target = {99.5F, 30, 0};
  const SeenSamples seen(ground, view);
  const Deviation all = screen_error(SurfaceRaster(drawing.frame(), 200, 2), ground, seen).in_frustum;
  ASSERT_EQ(all.samples, 400U);
  // 200 zeros in the second row, errors 0…99 twice in the first: rank 396 is the third error from the top.
  EXPECT_NEAR(all.largest, focal(view) * 99 / 400, 1e-3);
  EXPECT_NEAR(all.p99, focal(view) * 97 / 400, 1e-3);
  EXPECT_NEAR(all.mean, focal(view) * 49.5 / 400 / 2, 1e-3);
}

TEST(ScreenError, CountsWhatIsNotDrawn) {
  const Heightfield field = flat(33, 33);
  Drawing drawing(field);
  drawing.square(0, 0, 16);
  const View view = from_above(field);
  const ScreenDeviation error =
      screen_error(SurfaceRaster(drawing.frame(), 33, 33), field, SeenSamples(field, view));
  EXPECT_EQ(error.visible.samples, 17U * 17);
  EXPECT_EQ(error.visible.undrawn, 33U * 33 - 17 * 17);
}

TEST(SeenSamples, AWallHidesWhatLiesBehindIt) {
  Heightfield field = flat(41, 61);
  for (int i = 0; i < 41; ++i) field.at(i, 40) = 20;
  View view = level_view(field);
  const SeenSamples seen(field, view);
  EXPECT_EQ(seen.at(20, 50), Seen::kVisible);
  EXPECT_EQ(seen.at(20, 40), Seen::kVisible);  // its top
  for (int j = 0; j < 39; ++j) EXPECT_EQ(seen.at(20, j), Seen::kHidden) << j;
  view.target.z = view.eye.z + 1;
  EXPECT_EQ(SeenSamples(field, view).at(20, 50), Seen::kOutside);
}

TEST(SeenSamples, NothingIsHiddenFromAbove) {
  const Heightfield field = hilly(150, 120, 1);
  const SeenSamples seen(field, from_above(field));
  for (int j = 0; j < 120; ++j) {
    for (int i = 0; i < 150; ++i) ASSERT_EQ(seen.at(i, j), Seen::kVisible) << i << ' ' << j;
  }
}

// Compared with rays: a sample whose ray stays well above the ground is visible, and one whose ray runs deep
// underground is hidden.
TEST(SeenSamples, AgreesWithRaysOverTheGround) {
  const Heightfield field = hilly(120, 120, 1);
  View view;
  view.eye = {60, field.at(60, 100) + 4, 100};
  view.target = {60, 0, 0};
  const SeenSamples seen(field, view);
  std::size_t hidden = 0, visible = 0;
  for (int j = 0; j < 120; ++j) {
    for (int i = 0; i < 120; ++i) {
      if (seen.at(i, j) == Seen::kOutside) continue;
      const glm::vec3 p(i, field.at(i, j), j);
      const float length = glm::length(view.eye - p);
      float clearance = 1e9F, rise = 1e9F;
      for (float t = 0.1F; t < length; t += 0.1F) {
        const glm::vec3 q = p + (view.eye - p) * (t / length);
        const float above = q.y - height_on_cells(field, q.x, q.z);
        clearance = std::min(clearance, above);
        rise = std::min(rise, above / t);
      }
      if (rise > 0.005F) {  // more than three pixels
        ++visible;
        EXPECT_EQ(seen.at(i, j), Seen::kVisible) << i << ' ' << j;
      } else if (clearance < -2) {
        ++hidden;
        EXPECT_EQ(seen.at(i, j), Seen::kHidden) << i << ' ' << j;
      }
    }
  }
  EXPECT_GT(hidden, 500U);
  EXPECT_GT(visible, 500U);
}

TEST(Popping, IsTheMotionSeenFromTheLaterView) {
  Heightfield field = flat(17, 17);
  field.at(8, 8) = 2;
  Drawing coarse(field), fine(field);
  coarse.square(0, 0, 16);
  fine.squares(8);
  const SurfaceRaster before(coarse.frame(), 17, 17), after(fine.frame(), 17, 17);
  const View view = level_view(field);
  const SeenSamples seen(field, view);
  EXPECT_EQ(popping(before, before, seen).in_frustum.largest, 0);
  const Deviation pop = popping(before, after, seen).in_frustum;
  EXPECT_GE(pop.largest, focal(view) * 2 / (40 + 8) - 1e-4);
  EXPECT_EQ(pop.largest, popping(after, before, seen).in_frustum.largest);
  EXPECT_GT(pop.mean, 0);
}

TEST(ScreenError, IsTheSameForAnyNumberOfThreads) {
  const Heightfield field = hilly(300, 200, 3);
  Drawing drawing(field);
  drawing.squares(8);
  View view = level_view(field);
  view.eye.y = view.target.y = 30;
  const auto measured = [&] {
    return screen_error(SurfaceRaster(drawing.frame(), 300, 200), field, SeenSamples(field, view));
  };
  const ScreenDeviation many = measured();
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  const ScreenDeviation single = measured();
  EXPECT_EQ(many.visible.samples, single.visible.samples);
  EXPECT_EQ(many.visible.mean, single.visible.mean);
  EXPECT_EQ(many.visible.p99, single.visible.p99);
  EXPECT_EQ(many.in_frustum.mean, single.in_frustum.mean);
  EXPECT_GT(many.visible.p99, 0);
}

TEST(ScreenError, HoldsOnAScreenOfOnePixelAndFarAway) {
  const Heightfield field = hilly(40, 40);
  View view = from_above(field);
  view.width = view.height = 1;
  BruteForce lod(field);
  const auto error = [&] {
    return screen_error(SurfaceRaster(lod.update(view), 40, 40), field, SeenSamples(field, view));
  };
  EXPECT_EQ(error().visible.largest, 0);
  EXPECT_GT(error().visible.samples, 0U);
  view.eye = {1e30F, 1e30F, 0};
  EXPECT_EQ(error().in_frustum.samples, 0U);  // beyond the far plane
}

}  // namespace
}  // namespace terrabench::test
