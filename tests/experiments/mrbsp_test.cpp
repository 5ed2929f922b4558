// The experiments of the MRBSP paper on little ground: what they say must hold on any.
#include "experiments/mrbsp/mrbsp.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "experiments/mrbsp/ground.h"
#include "terrain/error.h"
#include "tests/terrain/temporary_folder.h"

namespace terrabench::mrbsp {
namespace {

constexpr std::string_view kGround = "topobathy";  // 120 × 91 samples: no power of two

using Measure = void (*)(const Case&, const RunOptions&, Recorder&, Progress&);

class MrbspExperiments : public testing::Test {
 protected:
  Record run(Measure measure, const Case& at) {
    Record record;
    Recorder recorder(record, folder_.path());
    std::filesystem::create_directories(folder_.path() / "figures");
    Progress progress;
    measure(at, RunOptions{}, recorder, progress);
    return record;
  }
  static double value(const Record& record, std::string_view metric) {
    const Metric* const found = record.find(metric);
    if (found == nullptr || found->samples.empty()) {
      ADD_FAILURE() << metric << " was not measured";
      return 0;
    }
    return found->samples.front();
  }

  TemporaryFolder folder_;
};

TEST_F(MrbspExperiments, AWalkIsCountedAndTimedInOrder) {
  Case at{"tiny", Parameters(kWalkParameters), std::string(kGround)};
  at.parameters.set("size", 0.0);
  at.parameters.set("frames", std::int64_t{1});
  const Record record = run(measure_walk, at);
  EXPECT_EQ(value(record, "views"), 240);
  EXPECT_EQ(value(record, "views_in_order"), 240);
  EXPECT_NEAR(value(record, "share_lod"), 3008.0 / 7238, 0.05);
  EXPECT_EQ(value(record, "share_brute"), 1);
  EXPECT_GT(value(record, "mean_both"), 0);
  EXPECT_LT(value(record, "mean_both"), value(record, "mean_vis"));
  EXPECT_GT(value(record, "lod_time"), 0);
  EXPECT_GT(value(record, "frame_time_both"), 0);
}

TEST_F(MrbspExperiments, OnlyTheFormulaForAreasKeepsTheSize) {
  Case at{"tiny", Parameters(kThresholdParameters), ""};
  const Record record = run(measure_threshold, at);
  EXPECT_NEAR(value(record, "slope_area"), 0, 0.05);
  EXPECT_NEAR(value(record, "slope_printed"), -0.5, 0.05);
  ASSERT_EQ(record.figures.size(), 1U);
  EXPECT_EQ(record.figures[0].id, "mrbsp.threshold");
}

TEST_F(MrbspExperiments, HolesAreThePrintedRulesAlone) {
  for (const bool conforming : {false, true}) {
    double holes = 0;
    for (const bool area : {false, true}) {
      Case at{"tiny", Parameters(kHoleParameters), std::string(kGround)};
      at.parameters.set("conforming", conforming);
      at.parameters.set("area", area);
      const Record record = run(measure_holes, at);
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

TEST_F(MrbspExperiments, ConservativeSetsMissNothingThatAPictureShows) {
  for (const bool conservative : {false, true}) {
    Case at{"tiny", Parameters(kVisibilityParameters), std::string(kGround)};
    at.parameters.set("conservative", conservative);
    const Record record = run(measure_visibility, at);
    EXPECT_GT(value(record, "seen"), 1000);
    if (conservative) {
      EXPECT_EQ(value(record, "missed"), 0);
      EXPECT_EQ(value(record, "missed_pixel_share"), 0);
    } else {
      EXPECT_GT(value(record, "missed"), 0);
    }
    EXPECT_GT(value(record, "bytes_changes"), 0);
  }
}

TEST_F(MrbspExperiments, TheProfileGivesTable1) {
  const Record record = run(measure_profile, profile_cases({}).front());
  EXPECT_EQ(value(record, "differing_lines"), 0);
  EXPECT_EQ(value(record, "lost_in_the_file"), 0);
  EXPECT_EQ(value(record, "changes"), 6);
  ASSERT_EQ(record.figures.size(), 1U);
  EXPECT_EQ(record.figures[0].id, "mrbsp.F2");
}

TEST_F(MrbspExperiments, LevelOfDetailGainsWithTheLand) {
  double before = 1;
  for (const std::int64_t n : {65, 129, 257}) {
    Case at{"tiny", Parameters(kLandParameters), ""};
    at.parameters.set("n", n);
    const double gain = value(run(measure_land, at), "gain");
    EXPECT_GT(gain, before);
    before = gain;
  }
}

TEST_F(MrbspExperiments, ADrawingKeepsItsRules) {
  Case at{"tiny", Parameters(kDrawingParameters), ""};
  at.parameters.set("n", std::int64_t{64});
  const Record record = run(measure_drawing, at);
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
  for (const auto cases : {walk_cases, hole_cases, visibility_cases}) {
    for (const Case& at : cases(options)) EXPECT_EQ(at.terrain, "topobathy");
  }
}

}  // namespace
}  // namespace terrabench::mrbsp
