// The detector finds planted cracks of every kind, and none in closed surfaces.
#include "lod/meters/cracks.h"

#include <gtest/gtest.h>

#include "lod/brute_force/brute_force.h"
#include "lod/meters/projector.h"
#include "tests/lod/drawing.h"

namespace terrabench::test {
namespace {

CrackReport report_of(const Drawing& drawing, const Heightfield& field) {
  return find_cracks(drawing.frame(), field.width, field.depth, from_above(field));
}

// Looks along the ground from the south, so that height differences are visible.
View from_south(const Heightfield& field) {
  View view;
  view.eye = {0.5F * field.extent_x(), 1, field.extent_z() + 20};
  view.target = {0.5F * field.extent_x(), 1, 0};
  return view;
}

// A coarse square in the west, two fine ones in the east: a T-junction at (4, 2).
Drawing coarse_beside_fine(const Heightfield& field) {
  Drawing drawing(field);
  drawing.square(0, 0, 4);
  for (const int j : {0, 2}) {
    for (const int i : {4, 6}) drawing.square(i, j, 2);
  }
  return drawing;
}

TEST(Cracks, NoneAtFullDetail) {
  const Heightfield field = hilly(100, 77, 5);
  BruteForce lod(field);
  const View view = from_above(field);
  const CrackReport report = find_cracks(lod.update(view), field.width, field.depth, view);
  EXPECT_TRUE(report.tight());
  EXPECT_EQ(report.t_junctions, 0U);
  EXPECT_EQ(report.largest_gap_m, 0);
}

TEST(Cracks, NoneAtTheRimOfWhatIsCulled) {
  const Heightfield field = hilly(300, 300, 5);
  BruteForce lod(field);
  View view;
  view.eye = {150, 60, 150};
  view.target = {100, 20, 60};
  const Frame& frame = lod.update(view);
  ASSERT_LT(frame.stats.triangles, std::size_t{299} * 299);
  EXPECT_TRUE(find_cracks(frame, field.width, field.depth, view).tight());
}

TEST(Cracks, LevelTJunctionIsNoGap) {
  Heightfield field = flat(9, 5, 7.1F);
  field.at(4, 0) = 3.3F;
  field.at(4, 4) = 12.7F;
  field.at(4, 2) = 0.5F * (3.3F + 12.7F);  // the mean of the edge's ends, within a float's rounding
  const CrackReport report = report_of(coarse_beside_fine(field), field);
  EXPECT_EQ(report.t_junctions, 1U);
  EXPECT_EQ(report.open_t_junctions, 0U);
  EXPECT_TRUE(report.tight());
}

TEST(Cracks, FindsTheGapOfATJunction) {
  Heightfield field = flat(9, 5, 2);
  field.cell_x = 3;
  field.cell_z = 5;
  field.at(4, 2) = 2.5F;
  const Drawing drawing = coarse_beside_fine(field);
  const View view = from_south(field);
  const CrackReport report = find_cracks(drawing.frame(), field.width, field.depth, view);
  EXPECT_EQ(report.t_junctions, 1U);
  EXPECT_EQ(report.open_t_junctions, 1U);
  EXPECT_EQ(report.gaps, 1U);
  EXPECT_EQ(report.bare_edges, 0U);
  EXPECT_EQ(report.overlaps, 0U);
  EXPECT_DOUBLE_EQ(report.largest_gap_m, 0.5);
  const Projector project(view);
  EXPECT_DOUBLE_EQ(report.largest_gap_px, project.pixels_between({12, 2, 10}, {12, 2.5, 10}));
  EXPECT_GT(report.largest_gap_px, 5);
  EXPECT_FALSE(report.tight());
}

TEST(Cracks, FindsGapsOnSlantedEdges) {
  Heightfield field = flat(7, 7);
  field.at(2, 2) = 1;  // on the diagonal from (0, 4) to (4, 0)
  Drawing drawing(field);
  drawing.triangle({0, 0}, {0, 4}, {4, 0});
  drawing.triangle({2, 2}, {0, 4}, {6, 6});
  drawing.triangle({4, 0}, {2, 2}, {6, 6});
  drawing.triangle({0, 4}, {0, 6}, {6, 6});
  drawing.triangle({4, 0}, {6, 6}, {6, 0});
  const CrackReport report = report_of(drawing, field);
  EXPECT_EQ(report.t_junctions, 1U);
  EXPECT_EQ(report.open_t_junctions, 1U);
  EXPECT_DOUBLE_EQ(report.largest_gap_m, 1);
  EXPECT_EQ(report.bare_edges, 0U);
}

TEST(Cracks, FindsGapsBetweenTheSameVertices) {
  // Two clip levels of the same spacing that differ in one height.
  const Heightfield low = flat(16, 16);
  Heightfield high = low;
  high.at(4, 2) = 1.5F;
  Drawing drawing(low);
  for (const int j : {0, 2}) {
    for (const int i : {0, 2}) drawing.square(i, j, 2);
  }
  drawing.batch(1);
  for (const int j : {0, 2}) {
    for (const int i : {4, 6}) drawing.square(i, j, 2);
  }
  const ClipLevel levels[] = {{.side = 16, .heights = low.heights}, {.side = 16, .heights = high.heights}};
  Frame frame = drawing.frame();
  frame.grid = {};
  frame.clip_levels = levels;
  frame.last = {15, 15};
  const CrackReport report = find_cracks(frame, low.width, low.depth, from_above(low));
  EXPECT_EQ(report.t_junctions, 0U);
  EXPECT_EQ(report.gaps, 1U);
  EXPECT_DOUBLE_EQ(report.largest_gap_m, 1.5);
}

TEST(Cracks, FindsAMissingTriangleWhereItIsInView) {
  const Heightfield field = hilly(21, 21);
  Drawing drawing(field);
  drawing.squares(1, {10, 10});
  drawing.triangle({10, 10}, {10, 11}, {11, 10});
  const CrackReport report = report_of(drawing, field);
  EXPECT_EQ(report.bare_edges, 3U);
  EXPECT_EQ(report.gaps, 0U);
  EXPECT_FALSE(report.tight());
  View away = from_above(field);
  away.target.y = 2 * away.eye.y;
  EXPECT_TRUE(find_cracks(drawing.frame(), 21, 21, away).tight());
}

TEST(Cracks, FindsATriangleDrawnTwice) {
  const Heightfield field = hilly(9, 9);
  Drawing drawing(field);
  drawing.squares(4);
  EXPECT_TRUE(report_of(drawing, field).tight());
  drawing.triangle({4, 0}, {0, 4}, {4, 4});
  const CrackReport report = report_of(drawing, field);
  EXPECT_EQ(report.overlaps, 3U);
  EXPECT_EQ(report.gaps, 0U);
}

TEST(Cracks, FindsALayerOverTheWholeGround) {
  const Heightfield field = flat(9, 9);
  Drawing drawing(field);
  drawing.squares(2);
  EXPECT_TRUE(report_of(drawing, field).tight());
  drawing.square(0, 0, 8);
  const CrackReport report = report_of(drawing, field);
  EXPECT_EQ(report.covered_again, 64U);
  EXPECT_EQ(report.overlaps, 16U);  // of the small squares' edges along the border
  EXPECT_FALSE(report.tight());
}

// The layer's rim is out of view, and it shares no edge with the ground below.
TEST(Cracks, FindsALayerWhoseRimIsOutOfView) {
  const Heightfield field = flat(101, 101);
  Drawing drawing(field);
  drawing.square(0, 0, 100);
  View view = from_above(field);
  view.eye.y = 10;
  ASSERT_TRUE(find_cracks(drawing.frame(), 101, 101, view).tight());
  drawing.square(10, 20, 60);
  const CrackReport report = find_cracks(drawing.frame(), 101, 101, view);
  EXPECT_EQ(report.bare_edges + report.overlaps, 0U);
  EXPECT_EQ(report.covered_again, 3600U);
  EXPECT_FALSE(report.tight());
}

// Triangulations without gaps cover each sample once, even with slivers and T-junctions.
TEST(Cracks, CountsNoSampleOfASurfaceTwice) {
  const Heightfield field = flat(200, 41);
  std::mt19937 random(3);
  const auto below = [&](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
  for (int round = 0; round < 200; ++round) {
    Drawing drawing(field);
    // Fans to the north and the south of a line, with different strides.
    const glm::ivec2 north(below(200), 0), south(below(200), 40);
    for (const bool up : {true, false}) {
      for (int x = 0; x < 199;) {
        const int next = std::min(x + 1 + below(60), 199);
        if (up) drawing.triangle(north, {x, 20}, {next, 20});
        if (!up) drawing.triangle(south, {next, 20}, {x, 20});
        x = next;
      }
    }
    drawing.triangle({0, 0}, {0, 20}, north);
    drawing.triangle({199, 0}, north, {199, 20});
    drawing.triangle({0, 40}, south, {0, 20});
    drawing.triangle({199, 40}, {199, 20}, south);
    const CrackReport report = report_of(drawing, field);
    ASSERT_TRUE(report.tight()) << round << ": " << report.covered_again;
  }
}

TEST(Cracks, FindsACellThatFacesDown) {
  const Heightfield field = hilly(21, 21);
  Drawing drawing(field);
  drawing.squares(1, {10, 10});
  drawing.triangle({10, 10}, {11, 10}, {10, 11});
  drawing.triangle({11, 10}, {11, 11}, {10, 11});
  const CrackReport report = report_of(drawing, field);
  EXPECT_EQ(report.flipped, 2U);
  EXPECT_EQ(report.faults(), 2U);
  EXPECT_FALSE(report.tight());
}

// Layers of different heights over each other: the one that is compared with the other side must not depend
// on chance; it is the lowest.
TEST(Cracks, ComparesLayersInAnOrderOfTheirOwn) {
  constexpr int kLayers = 4000, kHigh = 5000;
  const Heightfield field = flat(8, 8);
  std::vector<std::vector<float>> heights;
  std::vector<ClipLevel> levels;
  heights.reserve(kLayers + 1);
  Drawing drawing(field);
  const auto layer = [&](float height) {
    drawing.batch(static_cast<std::uint16_t>(levels.size()));
    levels.push_back({.side = 8, .heights = heights.emplace_back(64, height)});
  };
  for (int k = 0; k < kLayers; ++k) {
    layer(static_cast<float>(kLayers - k));
    drawing.triangle({4, 0}, {1, 3}, {4, 4});
  }
  layer(kHigh);
  drawing.triangle({4, 0}, {4, 4}, {7, 1});
  Frame frame = drawing.frame();
  frame.grid = {};
  frame.clip_levels = levels;
  frame.last = {7, 7};
  EXPECT_EQ(find_cracks(frame, 8, 8, from_above(field)).largest_gap_m, kHigh - 1);
}

TEST(Cracks, HangingSkirtsHideNothing) {
  Heightfield field = flat(9, 5);
  field.at(4, 2) = -1;
  Drawing drawing = coarse_beside_fine(field);
  drawing.triangle({4, 0}, {4, 2}, {4, 4});
  EXPECT_EQ(report_of(drawing, field).gaps, 1U);
}

TEST(Cracks, NoneInAnEmptyFrame) {
  const Heightfield field = flat(4, 4);
  EXPECT_TRUE(report_of(Drawing(field), field).tight());
}

}  // namespace
}  // namespace terrabench::test
