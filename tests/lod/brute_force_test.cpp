// The reference method draws every triangle in view once.
#include "lod/brute_force/brute_force.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "terrain/error.h"
#include "terrain/memory.h"
#include "tests/lod/drawing.h"

namespace terrabench {
namespace {

Heightfield hills(int width, int depth) {
  const auto hill = [](int i, int j) {
    return 5.0F * std::sin(0.1F * static_cast<float>(i)) + static_cast<float>(j % 7);
  };
  return test::ground_of(width, depth, hill, 2, 3);
}

double plan_area(const Frame& frame) {
  double area = 0;
  triangles(frame, [&](std::span<const glm::vec3> corners) {
    for (std::size_t k = 0; k < corners.size(); k += 3) {
      const glm::vec3 u = corners[k + 1] - corners[k], v = corners[k + 2] - corners[k];
      area += 0.5 * (static_cast<double>(u.z) * v.x - static_cast<double>(u.x) * v.z);
    }
  });
  return area;
}

TEST(BruteForce, DrawsEveryTriangleOfAnySize) {
  for (const auto& [width, depth] : {std::pair{2, 2}, {33, 33}, {34, 65}, {100, 37}}) {
    const Heightfield field = hills(width, depth);
    BruteForce lod(field);
    const Frame& frame = lod.update(test::from_above(field));
    EXPECT_EQ(frame.stats.triangles, std::size_t{2} * (width - 1) * (depth - 1));
    EXPECT_NEAR(plan_area(frame), field.extent_x() * field.extent_z(), 1e-6 * plan_area(frame));
  }
}

TEST(BruteForce, UploadsOnceOnly) {
  const Heightfield field = hills(50, 50);
  BruteForce lod(field);
  const std::size_t indices = lod.update(test::from_above(field)).indices.size();
  EXPECT_EQ(BruteForce(field).update(test::from_above(field)).stats.bytes_uploaded, 4 * (indices + 2500));
  EXPECT_EQ(lod.update(test::from_above(field)).stats.bytes_uploaded, 0U);
}

TEST(BruteForce, LeavesOutBlocksBehindTheEye) {
  const Heightfield field = hills(129, 129);
  BruteForce lod(field);
  View view;
  view.eye = {128, 10, 192};
  view.target = {128, 10, 0};
  const std::size_t ahead = lod.update(view).stats.triangles;
  EXPECT_GT(ahead, 0U);
  EXPECT_LT(ahead, std::size_t{2} * 128 * 128 * 2 / 3);
}

TEST(BruteForce, CountsItsHeapBytes) {
  const Heightfield field = hills(200, 200);
  const HeapScope heap;
  auto lod = std::make_unique<BruteForce>(field);
  lod->update(test::from_above(field));
  EXPECT_EQ(heap.held(), static_cast<std::int64_t>(lod->memory().total()));
}

TEST(CheckView, RefusesInvalidViews) {
  const auto refused = [](auto change) {
    View view;
    change(view);
    EXPECT_THROW(check_view(view), Error);
  };
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  refused([](View& v) { v.eye.x = kNan; });
  refused([](View& v) { v.eye.y = std::numeric_limits<float>::infinity(); });
  refused([](View& v) { v.target = v.eye; });
  refused([](View& v) { v.target = v.eye + glm::vec3(0, -5, 0); });  // parallel to up
  refused([](View& v) { v.vertical_fov = 0; });
  refused([](View& v) { v.vertical_fov = 4; });
  refused([](View& v) { v.width = 0; });
  refused([](View& v) { v.near = 0; });
  refused([](View& v) { v.far = v.near; });
  EXPECT_NO_THROW(check_view(View{}));
  View tiny;
  tiny.width = tiny.height = 1;
  EXPECT_NO_THROW(check_view(tiny));
}

TEST(CheckGround, RefusesHolesAndPoints) {
  Heightfield field = hills(4, 4);
  EXPECT_NO_THROW(check_ground(field));
  field.at(2, 2) = Heightfield::kNoData;
  EXPECT_THROW(check_ground(field), Error);
  EXPECT_THROW(check_ground(hills(1, 9)), Error);
}

}  // namespace
}  // namespace terrabench
