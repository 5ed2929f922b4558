#include <gmock/gmock.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <glm/geometric.hpp>
#include <iostream>
#include <memory>
#include <string>
#include <utility>

#include "renderers/ramp.h"
#include "renderers/scene.h"
#include "renderers/target.h"
#include "terrain/error.h"
#include "terrain/files.h"
#include "tests/renderers/ground.h"

namespace terrabench {
namespace {

using testing::ground;
using testing::hills;

int luminance(const Rgb& c) { return (2126 * c[0] + 7152 * c[1] + 722 * c[2]) / 10000; }

Rgb to_bytes(const glm::vec3& linear) {
  const glm::vec3 srgb = to_srgb(linear);
  Rgb bytes;
  for (int i = 0; i < 3; ++i)
    bytes[static_cast<std::size_t>(i)] = static_cast<std::uint8_t>(std::lround(srgb[i] * 255));
  return bytes;
}

void expect_close(const Rgb& got, const Rgb& wanted, int tolerance) {
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(got[i], wanted[i], tolerance) << "channel " << i;
}

// Looks straight down on [0, size]², north up; the ground extends beyond the picture.
View from_above(float size, float height, int pixels = 64) {
  View view;
  view.width = view.height = pixels;
  view.target = {0.5F * size, 0, 0.5F * size};
  view.eye = {0.5F * size, height, 0.5F * size};
  view.up = {0, 0, -1};
  view.vertical_fov = 2 * std::atan(0.4F * size / height);
  return view;
}

std::string checksum_of(const Image& image) { return checksum(std::as_bytes(std::span(image.rgb))); }

Image draw_hills(int pixels = 200) {
  const TriangleMesh mesh = ground(64, 10000, hills);
  const auto context = open_context("osmesa", pixels, pixels);
  return render_relief(*context, mesh, overview({{0, 0, 0}, {10000, 600, 10000}}, pixels, pixels),
                       {.lowest = 0, .highest = 600});
}

class Relief : public ::testing::Test {
 protected:
  Image draw(const TriangleMesh& mesh, const View& view, const ReliefStyle& style) {
    return render_relief(*context_, mesh, view, style);
  }
  std::unique_ptr<GlContext> context_ = open_context("osmesa", 64, 64);
};

TEST(Ramp, RisesInLightnessAllTheWay) {
  float before = -1;
  for (int i = 0; i <= 1000; ++i) {
    const glm::vec3 color = ramp_color(static_cast<float>(i) / 1000);
    const float luminance = glm::dot(color, glm::vec3(0.2126F, 0.7152F, 0.0722F));
    ASSERT_GT(luminance, before) << i;
    before = luminance;
    for (int c = 0; c < 3; ++c) {
      ASSERT_GT(color[c], 0) << "cut off at " << i;
      ASSERT_LT(color[c], 1) << "cut off at " << i;
    }
  }
  EXPECT_EQ(ramp_color(-5), ramp_color(0));
  EXPECT_EQ(ramp_color(5), ramp_color(1));
}

TEST_F(Relief, GivesLevelGroundTheRampsColor) {
  for (const float height : {0.0F, 25.0F, 50.0F, 100.0F}) {
    const TriangleMesh mesh = ground(4, 100, [&](float, float) { return height; });
    const Image image = draw(mesh, from_above(100, 300), {.lowest = 0, .highest = 100});
    expect_close(image.pixel(32, 32), to_bytes(ramp_color(height / 100)), 1);
    expect_close(image.pixel(3, 60), to_bytes(ramp_color(height / 100)), 1);
  }
}

TEST_F(Relief, OfARangeWithoutExtentStillShowsTheGround) {
  const TriangleMesh mesh = ground(4, 100, [](float, float) { return 7.0F; });
  const Image image = draw(mesh, from_above(100, 300), {.lowest = 7, .highest = 7});
  expect_close(image.pixel(32, 32), to_bytes(ramp_color(0)), 1);
}

TEST_F(Relief, IsLitFromTheNorthWest) {
  // A ridge from south-west to north-east: its north-western side is the upper left of the picture.
  const TriangleMesh mesh =
      ground(64, 100, [](float x, float z) { return 50 - 0.4F * std::abs(x + z - 100) / std::sqrt(2.0F); });
  const Image image = draw(mesh, from_above(100, 300), {.lowest = -1000, .highest = 1000});
  EXPECT_GT(luminance(image.pixel(16, 16)), luminance(image.pixel(48, 48)) + 40);
  ReliefStyle from_south_east{.lowest = -1000, .highest = 1000, .sun = {0.5F, 0.7F, 0.5F}};
  const Image turned = draw(mesh, from_above(100, 300), from_south_east);
  EXPECT_LT(luminance(turned.pixel(16, 16)) + 40, luminance(turned.pixel(48, 48)));
}

TEST_F(Relief, ShowsGentleSlopesToo) {
  const auto contrast = [&](float slope) {
    const TriangleMesh mesh = ground(
        64, 100, [&](float x, float z) { return 50 - slope * std::abs(x + z - 100) / std::sqrt(2.0F); });
    const Image image = draw(mesh, from_above(100, 300), {.lowest = -1000, .highest = 1000});
    return luminance(image.pixel(16, 16)) - luminance(image.pixel(48, 48));
  };
  EXPECT_GT(contrast(0.08F), 40);
  EXPECT_GT(contrast(0.4F), 40);
  EXPECT_EQ(contrast(0.0F), 0);
}

TEST_F(Relief, ShowsTheBacksOfTrianglesInGrey) {
  TriangleMesh mesh = ground(4, 100, [](float, float) { return 10.0F; });
  const ReliefStyle style{.lowest = 0, .highest = 20};
  const Image front = draw(mesh, from_above(100, 300), style);
  for (std::size_t t = 0; t < mesh.indices.size(); t += 3) std::swap(mesh.indices[t], mesh.indices[t + 1]);
  const Image back = draw(mesh, from_above(100, 300), style);
  expect_close(front.pixel(32, 32), to_bytes(ramp_color(0.5F)), 1);
  const Rgb grey = back.pixel(32, 32);
  EXPECT_LT(std::abs(grey[0] - grey[2]), 25);
  EXPECT_LT(luminance(grey), luminance(front.pixel(32, 32)));
}

TEST_F(Relief, LetsTheNearerGroundHideTheFarther) {
  // Two levels one metre apart, seen from 30 km in a view whose own depth range would clip both.
  const auto level = [](float height) { return ground(2, 10000, [&](float, float) { return height; }); };
  const auto join = [](TriangleMesh a, const TriangleMesh& b) {
    testing::append(a, b);
    return a;
  };
  View view = from_above(10000, 30000);
  view.near = 0.5F;
  view.far = 100;
  const ReliefStyle style{.lowest = 0, .highest = 1};
  for (const TriangleMesh& mesh : {join(level(0), level(1)), join(level(1), level(0))}) {
    const Image image = draw(mesh, view, style);
    for (int y = 0; y < 64; y += 7) {
      for (int x = 0; x < 64; x += 7) expect_close(image.pixel(x, y), to_bytes(ramp_color(1)), 1);
    }
  }
}

TEST_F(Relief, OfAMeshWithoutNormalsShowsFacets) {
  TriangleMesh mesh = ground(8, 10000, hills);
  const View view = from_above(10000, 30000);
  const ReliefStyle style{.lowest = 0, .highest = 600, .shading_exaggeration = 1};
  const Image smooth = draw(mesh, view, style);
  mesh.normals.clear();
  EXPECT_NE(draw(mesh, view, style).rgb, smooth.rgb);
  // A level facet has the ramp's colour with both kinds of shading.
  TriangleMesh flat = ground(4, 100, [](float, float) { return 10.0F; });
  flat.normals.clear();
  const Image image = draw(flat, from_above(100, 300), {.lowest = 0, .highest = 20});
  expect_close(image.pixel(20, 20), to_bytes(ramp_color(0.5F)), 1);
}

TEST_F(Relief, TakesTheSizeOfTheView) {
  const TriangleMesh mesh = ground(16, 10000, hills);
  const Bounds bounds{{0, 0, 0}, {10000, 600, 10000}};
  const Image before = draw(mesh, overview(bounds, 80, 60), {.highest = 600});
  const Image other = draw(mesh, overview(bounds, 31, 97), {.highest = 600});
  EXPECT_EQ(other.width, 31);
  EXPECT_EQ(other.height, 97);
  EXPECT_EQ(draw(mesh, overview(bounds, 80, 60), {.highest = 600}).rgb, before.rgb);
  View empty = overview(bounds, 80, 60);
  empty.width = 0;
  EXPECT_THROW(draw(mesh, empty, {}), Error);
}

TEST_F(Relief, OfATriangleWithoutExtentDrawsNothing) {
  TriangleMesh mesh;
  mesh.positions = {{1, 1, 1}, {1, 1, 1}, {1, 1, 1}};
  mesh.indices = {0, 1, 2};
  compute_normals(mesh);
  const Image image = draw(mesh, overview({{0, 0, 0}, {2, 2, 2}}, 16, 16), {});
  EXPECT_EQ(image.pixel(8, 8), (Rgb{255, 255, 255}));
}

// Mesa reads the number of threads once per process, so this runs other processes.
TEST(ReliefDeathTest, IsTheSameForAnyNumberOfThreads) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  const std::string expected = checksum_of(draw_hills());
  ASSERT_EQ(checksum_of(draw_hills()), expected);
  for (const char* const count : {"0", "1", "2", "7"}) {
    setenv("LP_NUM_THREADS", count, 1);
    EXPECT_EXIT(
        {
          std::cerr << checksum_of(draw_hills()) << std::endl;
          std::_Exit(0);
        },
        ::testing::ExitedWithCode(0), expected)
        << count << " threads";
  }
  unsetenv("LP_NUM_THREADS");
}

}  // namespace
}  // namespace terrabench
