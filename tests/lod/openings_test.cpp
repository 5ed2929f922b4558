// The meters for ground with overhangs find planted openings of every kind, and none in closed surfaces.
#include "lod/meters/openings.h"

#include <gtest/gtest.h>

#include "lod/brute_force/brute_force.h"
#include "lod/meters/bare_pixels.h"
#include "terrain/error.h"
#include "tests/lod/drawing.h"

namespace terrabench::test {
namespace {

View walker(const Heightfield& field, float above = 3) {
  View view;
  view.eye = {0.5F * field.extent_x(), 0, 0.9F * field.extent_z()};
  view.eye.y = field.sample(view.eye.x, view.eye.z) + above;
  view.target = view.eye + glm::vec3(0.1F, -0.3F, -1);
  view.width = 320;
  view.height = 200;
  view.near = 0.1F;
  return view;
}

Drawing squares(const Heightfield& field, glm::ivec2 without = {-1, -1}) {
  Drawing drawing(field);
  drawing.squares(1, without);
  return drawing;
}

TEST(Openings, NoneInTheFullTerrainFromAnywhere) {
  const Heightfield field = hilly(90, 80, 0.5F);
  BruteForce lod(field);
  for (const float above : {0.5F, 3.0F, 40.0F}) {
    for (const float x : {-1.0F, 0.3F, 1.0F}) {
      View view = walker(field, above);
      view.target.x += x;
      const Frame& frame = lod.update(view);
      const OpenEdges open = find_open_edges(frame, field, view);
      EXPECT_EQ(open.edges + open.unmatched, 0U);
      EXPECT_EQ(find_bare_pixels(frame, field, view).total(), 0U);
    }
  }
}

TEST(Openings, FindsAMissingSquare) {
  const Heightfield field = waves(60, 60, 1);
  const Drawing drawing = squares(field, {30, 43});
  const OpenEdges open = find_open_edges(drawing.frame(), field, walker(field));
  EXPECT_EQ(open.edges, 4U);
  EXPECT_EQ(open.unmatched, 0U);
  EXPECT_GT(open.largest_gap_m, 0.9);
  const BarePixels pixels = find_bare_pixels(drawing.frame(), field, walker(field));
  EXPECT_GT(pixels.bare, 5U);
  EXPECT_EQ(pixels.covered, 0U);
}

TEST(Openings, FindsASquareDrawnTwice) {
  const Heightfield field = waves(60, 60, 1);
  Drawing drawing = squares(field);
  drawing.square(30, 43, 1);
  EXPECT_EQ(find_open_edges(drawing.frame(), field, walker(field)).edges, 4U);
  const BarePixels pixels = find_bare_pixels(drawing.frame(), field, walker(field));
  EXPECT_GT(pixels.covered, 5U);
  EXPECT_EQ(pixels.bare, 0U);
}

TEST(Openings, MeasuresAStepBetweenTwoMeshes) {
  const Heightfield field = flat(9, 9);
  std::vector<glm::vec3> west = {{0, 0, 0}, {0, 0, 8}, {4, 0, 8}, {4, 0, 0}};
  std::vector<glm::vec3> east = {{4, 0, 0}, {4, 0, 8}, {8, 0, 8}, {8, 0, 0}};
  const std::vector<glm::vec3> up(4, glm::vec3(0, 1, 0));
  const std::vector<std::uint32_t> indices = {0, 1, 2, 0, 2, 3};
  std::vector<FrameMesh> meshes = {{1, west, up, indices}, {2, east, up, indices}};
  const auto frame = [&] { return Frame{.meshes = meshes, .stats = count({}, {}, 0, 0, meshes)}; };
  View view;
  view.eye = {4, 3, 16};
  view.target = {4, 0, 4};
  EXPECT_EQ(find_open_edges(frame(), field, view).edges, 0U);
  for (const std::size_t k : {0U, 1U}) east[k].y = 0.25F;
  const OpenEdges open = find_open_edges(frame(), field, view);
  EXPECT_EQ(open.edges, 2U);
  EXPECT_DOUBLE_EQ(open.largest_gap_m, 0.25);
  EXPECT_GT(open.largest_gap_px, 1);
  meshes[1].drawn = false;
  EXPECT_EQ(find_open_edges(frame(), field, view).unmatched, 1U);
}

// A vertex in the middle of the neighbour's edge: no gap on level ground, but the two are not one surface.
TEST(Openings, CountsTJunctions) {
  const Heightfield field = flat(9, 5);
  Drawing drawing(field);
  drawing.square(0, 0, 4);
  for (const int j : {0, 2}) {
    for (const int i : {4, 6}) drawing.square(i, j, 2);
  }
  const OpenEdges open = find_open_edges(drawing.frame(), field, from_above(field));
  EXPECT_EQ(open.edges, 3U);
  EXPECT_EQ(open.largest_gap_m, 0);
}

TEST(Openings, TrianglesWithoutAreaCoverNothing) {
  const Heightfield field = flat(60, 60);
  Drawing drawing = squares(field);
  const std::size_t before = find_bare_pixels(drawing.frame(), field, walker(field)).total();
  for (int i = 20; i < 40; ++i) drawing.triangle({i, 40}, {i, 40}, {i, 40});
  EXPECT_EQ(find_bare_pixels(drawing.frame(), field, walker(field)).total(), before);
  EXPECT_EQ(before, 0U);
}

TEST(Openings, PixelsNeedAnEyeOverTheGround) {
  const Heightfield field = flat(9, 9);
  View view = walker(field);
  view.eye.x = -5;
  EXPECT_THROW(find_bare_pixels(squares(field).frame(), field, view), Error);
}

}  // namespace
}  // namespace terrabench::test
