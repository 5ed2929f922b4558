// No cracks at any setting, no error above the bound, no popping, and the cost of a frame.
#include "lod/cdlod/cdlod.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "lod/camera/camera_path.h"
#include "terrain/error.h"
#include "tests/lod/drawing.h"
#include "tests/lod/promises.h"

namespace terrabench::test {
namespace {

using cdlod::fit_ranges, cdlod::kMorphStart, cdlod::LevelNeeds, cdlod::LevelRange;

Cdlod make(const Heightfield& field, const Cdlod::Options& options, double pixels) {
  Cdlod lod(field, options, silent());
  lod.tune(pixels);
  return lod;
}

// Without and with ranges by distance alone.
class CdlodBothWays : public ::testing::TestWithParam<bool> {};
INSTANTIATE_TEST_SUITE_P(Ranges, CdlodBothWays, ::testing::Bool(),
                         [](const auto& info) { return std::string(info.param ? "distance" : "errors"); });

TEST(Cdlod, KeepsItsPromisesOnAnyFieldFromAnywhere) {
  std::mt19937 random(7);
  double closest = 0;
  for (const auto& [width, depth] : {std::pair{2, 2}, {3, 100}, {65, 65}, {131, 70}, {403, 344}}) {
    const Heightfield field = hilly(width, depth, 0.5F, static_cast<unsigned>(width));
    for (const int side : {4, 16, 64}) {
      Cdlod lod = make(field, {side}, 1);
      for (int k = 0; k < 18; ++k) {
        const double pixels = std::array{0.5, 2.0, 9.0}[static_cast<std::size_t>(k % 3)];
        lod.tune(pixels);
        const View view = random_view(field, random);
        closest = std::max(closest, expect_promises(lod.update(view), field, view, pixels) / pixels);
        if (HasFailure()) FAIL() << width << " × " << depth << ", nodes of " << side;
      }
    }
  }
  EXPECT_GT(closest, 0.5);  // the bound is not met by drawing more than necessary
}

// The knob asks for ranges of a few cells, which are shorter than the nodes; ground is steeper than wide.
TEST_P(CdlodBothWays, RangesTooSmallForTheNodesOpenNoSeam) {
  const Heightfield field = hilly(180, 150, 4, 3);
  std::size_t levels = 0;
  for (const float steepness : {0.05F, 1.0F, 40.0F}) {
    Heightfield steep = field;
    for (float& height : steep.heights) height *= steepness;
    for (const int side : {4, 16}) {
      for (const double pixels : {3.0, 200.0}) {
        Cdlod lod = make(steep, {side, GetParam()}, pixels);
        const std::vector<View> path = views(camera_path("fly"), steep);
        for (std::size_t k = 0; k < path.size(); k += path.size() / 6) {
          const View& view = path[k];
          const Frame& frame = lod.update(view);
          const CrackReport cracks = find_cracks(frame, field.width, field.depth, view);
          ASSERT_TRUE(cracks.tight()) << steepness << ", nodes of " << side << ", " << pixels << " px";
          ASSERT_EQ(cracks.t_junctions, 0U);
          for (const Batch& batch : frame.batches) levels = std::max<std::size_t>(levels, batch.level);
        }
      }
    }
  }
  EXPECT_GE(levels, 3U);
}

// The same nodes open seams where vertices morph earlier: the enlarged ranges close them.
TEST(Cdlod, MorphingTooEarlyOpensSeams) {
  const Heightfield field = hilly(300, 280, 1, 3);
  const View view = views(camera_path("fly"), field)[100];
  Cdlod lod = make(field, {8, true}, 40);
  for (const float by : {1.0F, 0.3F}) {
    Frame frame = lod.update(view);
    std::vector<MorphRange> ranges(frame.morph_ranges.begin(), frame.morph_ranges.end());
    for (MorphRange& range : ranges) range = {by * range.from, by * range.to};
    frame.morph_ranges = ranges;
    EXPECT_EQ(find_cracks(frame, field.width, field.depth, view).tight(), by == 1) << by;
  }
}

TEST(FitRanges, HoldWhatClosesTheSurface) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(0, 1);
  constexpr std::size_t kLevels = 6;
  std::size_t as_wanted = 0, not_drawn = 0;
  for (int round = 0; round < 1000; ++round) {
    std::array<LevelNeeds, kLevels> needs;
    std::array<LevelRange, kLevels> ranges;
    for (LevelNeeds& need : needs) {
      const double size = std::pow(10, 4 * unit(random));
      need = {unit(random) < 0.3 ? 0 : 1000 * size * unit(random), 100 * size * unit(random),
              300 * size * unit(random), 30 * size, 2 * size * unit(random)};
    }
    fit_ranges(needs, ranges);
    double begin = 0, last_node = 0;
    for (std::size_t l = 0; l + 1 < kLevels; ++l) {
      const auto& [end, morph] = ranges[l];
      const auto from = static_cast<double>(morph.from), to = static_cast<double>(morph.to);
      if (end == 0) {
        EXPECT_EQ(begin, 0);
        EXPECT_EQ(needs[l].end, 0);
        ++not_drawn;
        continue;
      }
      EXPECT_GE(end, needs[l].end);
      EXPECT_GE(from, needs[l].from * (1 - 1e-6));
      EXPECT_NEAR(from, begin + kMorphStart * (end - begin), 1e-6 * end);
      EXPECT_LT(from, to);
      EXPECT_LE(to, end - needs[l].triangle);
      EXPECT_GE(to, needs[l].to * (1 - 1e-6));
      EXPECT_GE(from, begin > 0 ? begin + last_node : 0);
      as_wanted += end == needs[l].end ? 1 : 0;
      begin = end;
      last_node = needs[l].node;
    }
    EXPECT_TRUE(std::isinf(ranges.back().end));
  }
  EXPECT_GT(as_wanted, 100U);
  EXPECT_GT(not_drawn, 100U);
}

// All nodes of a level, with vertices that have morphed or not as their distances from random points say, and
// sides joined at random.
// A node of a coarse level spans many blocks, of which an edit measures few.
TEST(LevelErrors, ForgetAPeakThatIsLevelled) {
  constexpr int kSide = 16, kLevels = 6;
  Heightfield field = hilly(600, 500, 1);
  field.at(300, 200) += 1000;
  const GroundGrid grid = grid_of(field);
  cdlod::NodeTree tree(grid, kSide, kLevels);
  cdlod::LevelErrors errors(grid, tree, kSide, silent());
  field.at(300, 200) -= 1000;
  const SampleRect rect{{300, 200}, {300, 200}};
  tree.measure(grid, rect);
  errors.measure(grid, tree, rect);
  const cdlod::LevelErrors fresh(grid, tree, kSide, silent());
  for (int level = 0; level < kLevels; ++level) {
    EXPECT_EQ(errors.of(level).relief, fresh.of(level).relief) << level;
    EXPECT_EQ(errors.of(level).drawn, fresh.of(level).drawn) << level;
    EXPECT_EQ(errors.of(level).morphed, fresh.of(level).morphed) << level;
  }
}

TEST(LevelErrors, BoundEveryMorph) {
  constexpr int kSide = 8, kLevels = 4;
  const Heightfield field = hilly(77, 90, 2);
  const GroundGrid grid = grid_of(field);
  const cdlod::NodeTree tree(grid, kSide, kLevels);
  const cdlod::LevelErrors errors(grid, tree, kSide, silent());
  const cdlod::NodePatterns patterns(tree, kSide);
  std::mt19937 random(5);
  std::uniform_real_distribution<float> unit(0, 1);
  SurfaceRaster drawn(field.width, field.depth);
  for (int level = 0; level + 1 < kLevels; ++level) {
    const PatchGrid& nodes = tree.grid(level);
    std::vector<Batch> batches;
    std::array<MorphRange, kLevels> ranges;
    Frame frame{.grid = grid, .cell_x = grid.cell_x, .cell_z = grid.cell_z, .indices = patterns.indices()};
    frame.patch_side = kSide;
    frame.morph_ranges = ranges;
    const auto largest_error = [&](bool joined) {
      batches.clear();
      for (int z = 0; z < nodes.down(); ++z) {
        for (int x = 0; x < nodes.across(); ++x) {
          const PatchGrid::Patch node = nodes.patch(x, z);
          const IndexRange all = patterns.quarters(level, nodes.shape(node), 0, 4);
          const unsigned inside = (z > 0 ? 1U : 0) | (x + 1 < nodes.across() ? 2U : 0) |
                                  (z + 1 < nodes.down() ? 4U : 0) | (x > 0 ? 8U : 0);
          batches.push_back(
              {all.first_index, all.index_count, static_cast<std::uint32_t>(node.j0 * field.width + node.i0),
               static_cast<std::uint16_t>(level), joined ? static_cast<unsigned>(random()) & inside : 0});
        }
      }
      frame.batches = batches;
      drawn.draw(frame);
      float largest = 0;
      for (int j = 0; j < field.depth; ++j) {
        for (int i = 0; i < field.width; ++i)
          largest = std::max(largest, std::abs(drawn.at(i, j) - field.at(i, j)));
      }
      return largest;
    };
    EXPECT_EQ(largest_error(false), errors.of(level).drawn);
    float largest = 0;
    for (int round = 0; round < 300; ++round) {
      frame.eye = {77 * unit(random), 20 * unit(random), 90 * unit(random)};
      const float from = 60 * unit(random);
      ranges.fill({from, 1.001F * from});
      largest = std::max(largest, largest_error(true));
    }
    EXPECT_LE(largest, errors.of(level).morphed + 1e-5F) << level;
    EXPECT_GT(largest, 0.9F * errors.of(level).morphed) << level;
  }
}

// A spike in the corner of the screen, from where its vertex morphs to where it has gone.
TEST(Cdlod, TheBoundIsNearlyMet) {
  Heightfield field = flat(513, 33);
  field.at(3, 17) = 1;
  Cdlod lod = make(field, {16}, 4);
  double closest = 0;
  for (int x = 20; x < 500; x += 2) {
    View view;
    view.eye = {static_cast<float>(x), 3, 17};
    const float depth = static_cast<float>(x - 3) / std::sqrt(1 + 0.5F * 0.5F);
    view.vertical_fov = 0.8F;
    // Turned so that the spike is near the left edge of the screen.
    view.target = view.eye + glm::vec3(-depth, 0, -0.5F * depth);
    closest = std::max(closest, expect_promises(lod.update(view), field, view, 4));
  }
  EXPECT_GT(closest, 0.7 * 4);
}

TEST(Cdlod, RangesByDistanceDoubleWhereNodesAreSmall) {
  const Heightfield field = hilly(1025, 1025);
  Cdlod lod = make(field, {4, true}, 1);
  lod.update(from_above(field));
  const std::span<const LevelRange> ranges = lod.ranges();
  ASSERT_EQ(ranges.size(), 8U);
  for (std::size_t l = 1; l + 1 < ranges.size(); ++l) EXPECT_NEAR(ranges[l].end / ranges[l - 1].end, 2, 1e-9);
}

// At the end of its way a vertex lies on the surface of the coarser level, cut cells included.
TEST(MorphingNode, LeadsToTheCoarserSurface) {
  const Heightfield field = hilly(22, 16, 1);
  const GroundGrid grid = grid_of(field);
  const MorphingNode node(grid, 4, 1, {16, 8});  // 5 × 7 samples
  ASSERT_EQ(node.high, glm::ivec2(21, 15));
  const auto mean = [&](glm::ivec2 a, glm::ivec2 b) {
    return 0.5F * (field.at(a.x, a.y) + field.at(b.x, b.y));
  };
  EXPECT_FLOAT_EQ(node.coarser({18, 8}), mean({16, 8}, {20, 8}));
  EXPECT_FLOAT_EQ(node.coarser({16, 10}), mean({16, 8}, {16, 12}));
  EXPECT_FLOAT_EQ(node.coarser({18, 10}), mean({16, 12}, {20, 8}));
  for (const glm::ivec2 stays : {glm::ivec2{16, 8}, {20, 12}, {21, 8}, {21, 15}, {16, 15}}) {
    EXPECT_EQ(node.coarser(stays), field.at(stays.x, stays.y));
    EXPECT_EQ(node.place(stays, 0xF), stays);
  }
  // Between samples 12 and 15, a vertex at 14 lies two thirds of the way to the border.
  EXPECT_FLOAT_EQ(node.coarser({16, 14}), (field.at(16, 12) + 2 * field.at(16, 15)) / 3);
  EXPECT_FLOAT_EQ(node.coarser({21, 14}), (field.at(21, 12) + 2 * field.at(21, 15)) / 3);
  // The plane through the three corners of the coarser triangle in the south-east.
  const float south_west = field.at(16, 15), north_east = field.at(20, 12), south_east = field.at(20, 15);
  EXPECT_NEAR(node.coarser({18, 14}), north_east / 3 + south_west / 2 + south_east / 6, 1e-5);
}

TEST(MorphingNode, JoinsSidesToCoarserNeighbours) {
  const Heightfield field = hilly(40, 40, 1);
  const GroundGrid grid = grid_of(field);
  const MorphingNode node(grid, 4, 1, {8, 16});
  enum : unsigned { kNorth = 1, kEast = 2, kSouth = 4, kWest = 8 };
  EXPECT_EQ(node.place({10, 16}, kNorth), glm::ivec2(8, 16));
  EXPECT_EQ(node.place({10, 24}, kSouth), glm::ivec2(12, 24));
  EXPECT_EQ(node.place({8, 18}, kWest), glm::ivec2(8, 16));
  EXPECT_EQ(node.place({16, 22}, kEast), glm::ivec2(16, 24));
  for (const glm::ivec2 inside : {glm::ivec2{10, 18}, {12, 16}, {8, 20}})
    EXPECT_EQ(node.place(inside, 0xF), inside);
  EXPECT_EQ(node.place({10, 16}, kEast | kSouth | kWest), glm::ivec2(10, 16));
}

struct Flown {
  double popping = 0;  // the largest of any frame, pixels
  std::size_t changes = 0;
};

Flown fly(const Heightfield& field, const std::vector<View>& path, const Cdlod::Options& options,
          double pixels) {
  Cdlod lod = make(field, options, pixels);
  Flown flown;
  SurfaceRaster before(field.width, field.depth), after(field.width, field.depth);
  before.draw(lod.update(path[0]));
  for (std::size_t k = 1; k < path.size(); ++k) {
    const Frame& frame = lod.update(path[k]);
    after.draw(frame);
    flown.changes += frame.stats.changes;
    flown.popping =
        std::max(flown.popping, popping(before, after, SeenSamples(field, path[k])).in_frustum.largest);
    std::swap(before, after);
  }
  return flown;
}

// With everything in view, no cut nodes and small steps, levels change without popping.
TEST_P(CdlodBothWays, NothingJumps) {
  const Heightfield field = hilly(257, 257, 0.05F);
  std::vector<View> path(60);
  for (std::size_t k = 0; k < path.size(); ++k) {
    path[k].eye = {100, 280 - 0.8F * static_cast<float>(k), 600 - 0.8F * static_cast<float>(k)};
    path[k].target = {128, 0, 128};
  }
  const double pixels = GetParam() ? 3 : 1;
  const Flown with = fly(field, path, {8, GetParam()}, pixels),
              without = fly(field, path, {8, GetParam(), false}, pixels);
  EXPECT_EQ(with.changes, without.changes);
  EXPECT_GT(with.changes, 50U);
  EXPECT_GT(without.popping, 0.25);
  EXPECT_LT(with.popping, 0.2 * without.popping);
}

TEST(Cdlod, DrawsFlatLandAtTheCoarsestLevel) {
  const Heightfield field = flat(257, 257, 700);
  Cdlod lod = make(field, {16}, 0.05);
  EXPECT_EQ(lod.update(from_above(field)).stats.triangles, 2U * 16 * 16);
  View view = from_above(field);
  view.target.y = 2 * view.eye.y;
  EXPECT_EQ(lod.update(view).stats.triangles, 0U);
}

TEST_P(CdlodBothWays, UploadsOnceAndCountsChanges) {
  const Heightfield field = hilly(300, 200, 0.1F);
  Cdlod lod = make(field, {16, GetParam()}, 9);
  const std::vector<View> all = views(camera_path("fly"), field);
  const Frame& first = lod.update(all[0]);
  EXPECT_EQ(first.stats.bytes_uploaded, 4 * (first.indices.size() + field.heights.size()));
  EXPECT_GT(first.stats.changes, 0U);
  EXPECT_EQ(lod.update(all[0]).stats.changes, 0U);
  const Frame& later = lod.update(all[100]);
  EXPECT_GT(later.stats.changes, 0U);
  EXPECT_EQ(later.stats.bytes_uploaded, 0U);
}

TEST_P(CdlodBothWays, TakesNoHeapBytesAFrame) {
  const Heightfield field = hilly(300, 257, 1);
  Cdlod lod = make(field, {16, GetParam()}, 1);
  const std::vector<View> all = views(camera_path("fly"), field);
  for (const View& view : all) lod.update(view);
  const std::int64_t live = HeapCounter::live();
  HeapCounter::reset_peak();
  for (const View& view : all) lod.update(view);
  EXPECT_EQ(HeapCounter::peak(), live);
}

TEST(Cdlod, RefusesNodesOfOtherSizes) {
  const Heightfield field = flat(9, 9);
  const LodType& type = lod("cdlod");
  Parameters parameters(type.parameters);
  for (const std::int64_t wrong : {2, 5, 48, 512}) {
    EXPECT_THROW(
        {
          parameters.set("node", wrong);
          (void)type.build(field, parameters, silent());
        },
        Error)
        << wrong;
  }
}

}  // namespace
}  // namespace terrabench::test
