// The experiments of the MRBSP paper on small ground, whose results must hold on any ground.

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "experiments/mrbsp/extruded_profile.h"
#include "experiments/mrbsp/ground.h"
#include "experiments/mrbsp/lost_pixels.h"
#include "experiments/mrbsp/methods.h"
#include "lod/mrbsp/bisection_tree.h"
#include "lod/mrbsp/visibility/coarse_squares.h"
#include "terrain/error.h"
#include "tests/experiments/value.h"

namespace terrabench::mrbsp {
namespace {

constexpr std::string_view kGround = "topobathy";  // 120 × 91 samples: not powers of two

Record on_ground(std::string_view id, std::initializer_list<std::pair<std::string_view, Value>> given) {
  return measured(id, given, kGround);
}

TEST(MrbspExperiments, AWalkIsCountedAndTimedInOrder) {
  const Record record =
      on_ground("mrbsp.walk", {{"size", 0.0}, {"frames", std::int64_t{1}}, {"pictures", std::int64_t{8}}});
  EXPECT_EQ(value(record, "triangles_all"), 2 * 119 * 90);
  EXPECT_EQ(value(record, "views"), 240);
  EXPECT_NEAR(value(record, "share_lod"), 3008.0 / 7238, 0.05);
  EXPECT_GT(value(record, "mean_both"), 0);
  EXPECT_LT(value(record, "mean_both"), value(record, "mean_vis"));
  EXPECT_GT(value(record, "lod_time"), 0);
  EXPECT_GT(value(record, "toggled_per_view"), 0);
  EXPECT_GT(value(record, "toggle_to_lod_time"), 0);
  EXPECT_GT(value(record, "frame_time_both"), 0);
  EXPECT_GT(value(record, "lod_frame_share"), 0);
  EXPECT_LT(value(record, "lod_frame_share"), 1);
  EXPECT_EQ(value(record, "triangles_shown"), 2 * 119 * 90);
  EXPECT_EQ(value(record, "least_time_share_brute"), 1);
}

// On small ground 64² cells are single samples, and fewer cells draw more.
TEST(MrbspExperiments, FittedCellsDrawThePapersShareAsWellAsAnyNumberDoes) {
  const double fitted = value(on_ground("mrbsp.walk", {{"cells", std::int64_t{0}}}), "share_vis");
  for (const int cells : kCells) {
    const Record record = on_ground("mrbsp.walk", {{"cells", std::int64_t{cells}}});
    EXPECT_GE(std::abs(value(record, "share_vis") - 2755.0 / 7238), std::abs(fitted - 2755.0 / 7238));
  }
}

TEST(MrbspExperiments, ConservativeSetsLeaveNoPictureOpen) {
  for (const std::string sets : {"interior", "conservative"}) {
    const Record record = on_ground("mrbsp.walk", {{"sets", sets}, {"pictures", std::int64_t{12}}});
    EXPECT_EQ(value(record, "pictures"), 12);
    EXPECT_GT(value(record, "ground_share_vis"), 0.1);
    for (const std::string method : {"vis", "both"}) {
      if (sets == "conservative") {
        for (const char* const metric :
             {"most_lost_", "most_open_", "open_views_", "lost_share_", "apparent_share_"}) {
          EXPECT_EQ(value(record, metric + method), 0) << metric << method;
        }
      } else {
        EXPECT_GT(value(record, "most_lost_" + method), 0);
        EXPECT_GE(value(record, "most_lost_" + method), value(record, "most_open_" + method));
        EXPECT_GE(value(record, "most_lost_share_" + method), value(record, "lost_share_" + method));
        // Shares of visible pixels, not of the picture.
        EXPECT_GE(value(record, "most_lost_share_" + method) * 800 * 600,
                  value(record, "most_lost_" + method));
        EXPECT_EQ(value(record, "apparent_share_" + method) > 0,
                  value(record, "most_lost_share_" + method) > 0.01);
      }
    }
  }
}

TEST(LostPixels, KeysTellTrianglesOfLargeGroundApart) {
  Progress progress;
  Heightfield field;
  field.width = 1100;
  field.depth = 1000;  // more than 2^20 samples
  field.heights.assign(std::size_t{1100} * 1000, 0.0F);
  MrbspOptions options;
  options.cull = false;
  Mrbsp lod(field, options, progress);
  lod.tune(kFinest);
  View view;
  view.eye = {550, 10, 500};
  view.target = {550, 0, 501};
  view.far = 1e5F;
  const Frame& frame = lod.update(view);
  std::vector<std::uint64_t> keys;
  for (std::uint32_t t = 0; t < frame.stats.triangles; ++t) keys.push_back(triangle_key(frame, t));
  EXPECT_EQ(keys.size(), 2U * 1099 * 999);
  std::sort(keys.begin(), keys.end());
  EXPECT_EQ(std::adjacent_find(keys.begin(), keys.end()), keys.end());
}

TEST(MrbspExperiments, OnlyTheFormulaForAreasKeepsTheSize) {
  const Record record = measured("mrbsp.threshold");
  EXPECT_NEAR(value(record, "slope_area"), 0, 0.05);
  EXPECT_NEAR(value(record, "slope_printed"), -0.5, 0.05);
  ASSERT_EQ(record.figures.size(), 1U);
  EXPECT_EQ(record.figures[0].id, "mrbsp.threshold");
}

TEST(MrbspExperiments, HolesAreThePrintedRulesAlone) {
  for (const bool conforming : {false, true}) {
    double holes = 0;
    for (const bool area : {false, true}) {
      const Record record = on_ground("mrbsp.holes", {{"conforming", conforming}, {"area", area}});
      holes += value(record, "holes");
      EXPECT_GT(value(record, "triangles_per_frame"), 0);
    }
    if (conforming) {
      EXPECT_EQ(holes, 0);
    } else {
      EXPECT_GT(holes, 0);
    }
  }
}

TEST(MrbspExperiments, ConservativeSetsMissNothingThatAPictureShows) {
  double missed_before = 1e9;
  for (const std::string sets : {"interior", "facing", "sampled", "vertices", "conservative"}) {
    const Record record = on_ground("mrbsp.visibility", {{"sets", sets}});
    EXPECT_GT(value(record, "seen"), 1000);
    EXPECT_LE(value(record, "missed"), missed_before) << sets;  // each covers more than the one before
    missed_before = value(record, "missed");
    EXPECT_EQ(value(record, "missed") == 0, value(record, "missed_pixel_share") == 0) << sets;
    EXPECT_EQ(value(record, "table1_lines_that_differ") == 0, sets == "interior" || sets == "facing");
    EXPECT_GT(value(record, "table2_share_vis"), value(record, "table2_share_both"));
    EXPECT_GT(value(record, "bytes_changes"), 0);
  }
  EXPECT_EQ(missed_before, 0);
}

TEST(MrbspExperiments, SmallerCellsAndLevelOfDetailAreComparedWithBruteForce) {
  const Record cells = on_ground("mrbsp.cells", {{"views", std::int64_t{1}}});
  EXPECT_LT(value(cells, "share_64"), value(cells, "share_4"));
  EXPECT_GT(value(cells, "least_time_share_4"), 0);
  double similar = 0;
  for (const double size : {0.05, 4.0, kFinest}) {
    const Record record = on_ground("mrbsp.quality", {{"size", size}, {"views", std::int64_t{2}}});
    EXPECT_GT(value(record, "mean_ssim_lod"), similar);
    EXPECT_GE(value(record, "mean_ssim_lod"), value(record, "least_ssim_lod"));
    similar = value(record, "mean_ssim_lod");
    EXPECT_EQ(value(record, "psnr_lod") == 100, size == kFinest);
    EXPECT_GE(value(record, "share_uniform"), value(record, "share_lod"));
  }
  EXPECT_EQ(similar, 1);
}

TEST(MrbspExperiments, TheProfileGivesTable1) {
  const Record record = measured("mrbsp.profile");
  EXPECT_EQ(value(record, "differing_lines_facing"), 0);
  EXPECT_EQ(value(record, "lost_in_the_file"), 0);
  EXPECT_EQ(value(record, "changes"), 6);
  ASSERT_EQ(record.figures.size(), 2U);
  EXPECT_EQ(record.figures[0].id, "mrbsp.F2");
  EXPECT_EQ(record.figures[1].id, "mrbsp.T1");
  EXPECT_GT(value(record, "alike_within_half_a_metre_facing"), 0.5);
}

std::vector<ProfileStep> sampled_steps(std::span<const float> profile) {
  Progress progress;
  const Heightfield strip = extrude(profile);
  return profile_steps(strip, find_changes(strip, visibility::Mode::kFacing, progress), progress);
}

TEST(ExtrudedProfile, ChangesWithTheShapeOfTheLand) {
  // Every point of a bowl sees the whole bowl.
  std::vector<float> bowl;
  for (int k = -8; k <= 8; ++k) bowl.push_back(0.1F * static_cast<float>(k * k));
  for (const ProfileStep& step : sampled_steps(bowl)) {
    EXPECT_TRUE(step.coarse.empty());
    EXPECT_TRUE(step.fine.empty());
  }
  // With rims below the ridge no cell sees over it: the step across it is the only change.
  std::vector<float> low(table1_profile().begin(), table1_profile().end());
  low.front() = low.back() = 8.5F;
  const std::vector<ProfileStep> steps = sampled_steps(low);
  ASSERT_EQ(steps.size(), 7U);
  for (std::size_t k = 0; k < steps.size(); ++k) {
    EXPECT_EQ(steps[k].coarse.size(), k == 3 ? 4U : 0U) << k;
    EXPECT_EQ(steps[k].fine.size(), k == 3 ? 16U : 0U) << k;
    EXPECT_TRUE(steps[k].whole);
  }
}

// On a square of equal profiles each row of cells sees of its own row of squares what the strip's cells see.
TEST(ExtrudedProfile, IsTheSameOnASquare) {
  Progress progress;
  const Heightfield strip = extrude(table1_profile());
  Heightfield square = strip;
  square.depth = square.width;
  square.heights.clear();
  for (int row = 0; row < square.depth; ++row) {
    square.heights.insert(square.heights.end(), table1_profile().begin(), table1_profile().end());
  }
  const visibility::Sets narrow = sets_of(find_changes(strip, visibility::Mode::kFacing, progress));
  const visibility::Sets wide = sets_of(find_changes(square, visibility::Mode::kFacing, progress));
  ASSERT_EQ(wide.cells.rows, kProfileCells);
  ASSERT_EQ(wide.depth, narrow.depth);
  const visibility::CoarseSquares squares(BisectionTree::over(square.width, square.depth), wide.depth);
  const int cells_a_square = squares.side() / wide.cells.side;
  for (int cell = 0; cell < wide.cells.count(); ++cell) {
    const int column = cell % wide.cells.columns, row = cell / wide.cells.columns / cells_a_square;
    for (int x = 0; x < squares.along(); ++x) {
      for (const int half : {0, 1}) {
        EXPECT_EQ(wide.sees(cell, squares.element({x, row}, half)),
                  narrow.sees(column, squares.element({x, 0}, half)));
      }
    }
  }
}

TEST(MrbspExperiments, OnlyPointsOnVerticesLeaveThePrintedHeightsWhole) {
  for (const std::int64_t points : {33, 32}) {
    const Record record = on_ground("mrbsp.heights", {{"points", points}, {"depth", std::int64_t{10}}});
    EXPECT_EQ(value(record, "levels_not_whole"), 0);
    EXPECT_GT(value(record, "torn_share"), 0.5);
    EXPECT_EQ(value(record, "torn_shared") == 0, points == 33);
    EXPECT_EQ(value(record, "vertices"), (33 * 33 + 1) / 2);
  }
}

TEST(MrbspExperiments, LevelOfDetailGainsWithTheLand) {
  double before = 1;
  for (const std::int64_t n : {65, 129, 257}) {
    const double gain = value(measured("mrbsp.land", {{"n", n}}), "gain");
    EXPECT_GT(gain, before);
    before = gain;
  }
}

TEST(MrbspExperiments, ADrawingKeepsItsRules) {
  const Record record = measured("mrbsp.drawing", {{"n", std::int64_t{64}}});
  EXPECT_EQ(value(record, "broken_greys"), 0);
  EXPECT_EQ(value(record, "mountain_samples_moved"), 0);
  EXPECT_GT(value(record, "mountain_samples"), 0);
  EXPECT_EQ(record.figures.size(), 1U);
}

TEST(MrbspGround, HasThePapersTrianglesAndEyesAboveThem) {
  for (const std::string& name : grounds({}, true)) {
    const TerrainSource source = open_ground(name, 1);
    const Heightfield& field = *source.heights;
    const BisectionTree tree = BisectionTree::over(field.width, field.depth, depth_over(field));
    EXPECT_EQ(tree.triangles(), 65536U);
    const std::vector<View> views = walk(field, 240);
    std::set<std::pair<float, float>> places;
    for (const View& view : views) {
      EXPECT_GE(view.eye.y, field.sample(view.eye.x, view.eye.z) + 1.79F);
      EXPECT_GE(view.eye.y, surface_height(tree, grid_of(field), view.eye.x, view.eye.z) + 1.79F);
      EXPECT_NE(view.eye, view.target);
      places.emplace(view.eye.x, view.eye.z);
    }
    EXPECT_EQ(places.size(), views.size()) << name;
  }
}

TEST(MrbspGround, RefusesASolid) { EXPECT_THROW(open_ground("caves", 1), Error); }

TEST(MrbspCases, TheOptionsNameTheGround) {
  RunOptions options;
  options.terrains = {"topobathy"};
  for (const char* const id : {"mrbsp.walk", "mrbsp.holes", "mrbsp.visibility", "mrbsp.heights"}) {
    for (const Case& at : experiment(id).cases(options)) EXPECT_EQ(at.terrain, "topobathy");
  }
}

}  // namespace
}  // namespace terrabench::mrbsp
