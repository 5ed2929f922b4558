// The comparison of all representations: its cases, and what it measures on small ground.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <set>
#include <string>

#include "experiments/cross/representations/representation_costs.h"
#include "experiments/experiment.h"
#include "representations/representation.h"
#include "results/claims/ranking.h"
#include "results/store/statistics.h"
#include "terrain/files.h"
#include "tests/experiments/value.h"

namespace terrabench::cross {
namespace {

constexpr std::string_view kId = "cross.representations";

Record measure(std::string_view type, const std::string& terrain, double error = 0,
               std::int64_t resolution = 24) {
  const Experiment& compared = experiment(kId);
  const Case at{"small",
                {compared.parameters,
                 {{"representation", std::string(type)},
                  {"error", error},
                  {"size", std::int64_t{65}},
                  {"resolution", resolution},
                  {"lines", std::int64_t{41}},
                  {"rays", std::int64_t{300}}}},
                terrain};
  Record record;
  Recorder recorder(record, "unused");
  Progress progress;
  compared.measure(at, {}, recorder, progress);
  return record;
}

TEST(RepresentationCases, NameEveryType) {
  std::set<std::string> names;
  RunOptions options;
  options.profile = Profile::kPaper;
  for (const Case& at : experiment(kId).cases(options)) names.insert(at.name);
  for (const RepresentationType& type : representations()) {
    const std::string heights = fmt::format("fractal/{}", type.name),
                      solid = fmt::format("caves/{}", type.name);
    for (const char* const suffix : {"", "/rmse=0.1%", "/rmse=0.5%", "/rmse=2%"})
      EXPECT_TRUE(names.contains(heights + suffix)) << heights << suffix;
    for (const char* const suffix : {"", "/volume=0.5%", "/volume=1%", "/volume=2%"})
      EXPECT_TRUE(names.contains(solid + suffix)) << solid << suffix;
    EXPECT_FALSE(names.contains(solid + "/rmse=0.1%"));
  }
}

// Rankings read both in every profile.
TEST(RepresentationCases, QuickHasTheFineAndTheCoarseError) {
  std::set<std::string> names;
  for (const Case& at : experiment(kId).cases({})) names.insert(at.name);
  for (const char* const at : {"/rmse=0.1%", "/rmse=2%"})
    EXPECT_TRUE(names.contains("jacksboro/tin" + std::string(at))) << at;
  for (const char* const at : {"/volume=0.5%", "/volume=2%"})
    EXPECT_TRUE(names.contains("caves/voxel" + std::string(at))) << at;
}

TEST(RepresentationCases, AreRankedOnlyWhereTheyAreComparable) {
  std::set<std::string> needed;
  for (const RankingLayout& ranking : ranking_layouts()) {
    if (ranking.experiment == kId) needed.insert(ranking.needs);
  }
  EXPECT_EQ(needed, (std::set<std::string>{"same_error", "rebuilt", "event_rebuilt"}));
}

class Compared : public testing::TestWithParam<std::string_view> {};
INSTANTIATE_TEST_SUITE_P(Types, Compared,
                         testing::Values("heightmap", "layered_stack", "voxel", "dense_voxel", "implicit",
                                         "drill", "ght", "tin"),
                         [](const auto& at) { return std::string(at.param); });

TEST_P(Compared, HoldsHeights) {
  const Record found = measure(GetParam(), "fractal");
  EXPECT_EQ(value(found, "bytes"), value(found, "heap_bytes"));
  EXPECT_EQ(value(found, "payload") + value(found, "index") + value(found, "slack"), value(found, "bytes"));
  EXPECT_EQ(value(found, "loaded_differs"), 0);
  EXPECT_EQ(value(found, "columns"), 65 * 65);
  EXPECT_EQ(value(found, "lost_columns"), 0);
  EXPECT_GT(value(found, "volume_iou"), 0.9);
  if (representation(GetParam()).traits.lossless) {
    EXPECT_EQ(value(found, "largest_error"), 0);
  } else {
    EXPECT_GT(value(found, "largest_error"), 0);
  }
  EXPECT_LE(value(found, "rmse"), value(found, "largest_error"));
  EXPECT_LE(value(found, "error_p99"), value(found, "largest_error"));
  EXPECT_GE(value(found, "hausdorff"), 0);
  if (representation(GetParam()).traits.rays) {
    EXPECT_GT(value(found, "ray_agreement"), 0.8);
  }
  EXPECT_GT(value(found, "dig_time"), 0);
}

TEST_P(Compared, HoldsSolids) {
  const Record found = measure(GetParam(), "caves");
  EXPECT_EQ(value(found, "bytes"), value(found, "heap_bytes"));
  EXPECT_GT(value(found, "cavities"), 0);
  const double lost = value(found, "cavities_lost");
  EXPECT_GE(lost, 0);
  EXPECT_LE(lost, 1);
  // 24 cells are too coarse for the implicit surface's kernel, and a tree takes overhangs from events alone.
  if (GetParam() == "heightmap" || GetParam() == "drill" || GetParam() == "tin") {
    EXPECT_GT(lost, 0.9);
  } else if (GetParam() != "implicit" && GetParam() != "ght") {
    EXPECT_LT(lost, 0.6);
  }
}

// It keeps the error with more memory than it would need: at its own expense.
TEST(ComparedAtErrors, ATreeWithEventsTakesPartWhereCoarserOnesAreRefused) {
  const Record found = measure("ght", "sequence", 0.05);
  EXPECT_LT(value(found, "of_asked"), 0.9);
  EXPECT_EQ(value(found, "same_error"), 1);
}

// The tunnel is 0.2 % of the canyon's volume: a heightmap that fills it has little error of volume.
TEST(ComparedAtErrors, TypesThatFillOverhangsDoNotHaveTheErrorOfASolid) {
  const Record stack = measure("layered_stack", "canyon", 0.02, 96),
               heights = measure("heightmap", "canyon", 0.02, 96);
  EXPECT_GE(value(stack, "of_asked"), 0.9);
  EXPECT_EQ(value(stack, "same_error"), 1);
  EXPECT_GE(value(stack, "volume_iou"), 0.98);
  EXPECT_GE(value(stack, "air_iou"), 0.6);
  EXPECT_EQ(value(heights, "same_error"), 0);
  EXPECT_GT(value(heights, "least_error"), 0.04);
  EXPECT_EQ(heights.find("bytes"), nullptr);
}

TEST_P(Compared, HasTheErrorAsked) {
  const Record found = measure(GetParam(), "fractal", 0.03);
  // On 65 samples the kernel's width and the drills' windows are long against the ground's features.
  if (GetParam() == "implicit" || GetParam() == "drill") {
    EXPECT_EQ(value(found, "same_error"), 0);
    EXPECT_GT(value(found, "least_of_relief"), 0.03);
    EXPECT_EQ(found.find("file_bytes"), nullptr);
    return;
  }
  EXPECT_LE(value(found, "of_asked"), 1);
  EXPECT_GE(value(found, "of_asked"), 0.6);  // 65 samples make coarse steps
  EXPECT_EQ(value(found, "same_error"), 1);
  EXPECT_LT(value(found, "file_bytes"), 65 * 65 * 4);
  EXPECT_EQ(value(found, "bytes"), value(found, "heap_bytes"));
}

TEST(ComparedAtErrors, AtTheErrorOfTheRankingsAllIsMeasured) {
  const Record ranked = measure("heightmap", "fractal", 0.02), other = measure("heightmap", "fractal", 0.03);
  for (const char* const metric : {"mesh_time", "rays_above", "dig_triangles", "event_time"}) {
    EXPECT_NE(ranked.find(metric), nullptr) << metric;
    EXPECT_EQ(other.find(metric), nullptr) << metric;
  }
}

TEST(ComparedAtErrors, ATypeThatCannotReachAnErrorHasNoFile) {
  const Record found = measure("implicit", "fractal", 1e-5);
  EXPECT_EQ(value(found, "same_error"), 0);
  EXPECT_GT(value(found, "least_of_relief"), 1e-5);
  for (const char* const metric : {"file_bytes", "bytes", "build_time", "rmse", "of_asked"}) {
    EXPECT_EQ(found.find(metric), nullptr) << metric;
  }
}

TEST_P(Compared, MeshesAgainOnlyWhatAnEditChanged) {
  const Record found = measure(GetParam(), "fractal");
  const double all = value(found, "triangles");
  for (const char* const metric : {"dig_triangles", "fill_triangles", "event_triangles"}) {
    EXPECT_GT(value(found, metric), 0) << metric;
    EXPECT_LT(value(found, metric), 1.1 * all) << metric;
  }
  if (GetParam() == "heightmap") {
    // A circle of a sixteenth of the side: radius 4 cells, at the border half of it.
    EXPECT_LT(value(found, "dig_triangles"), 2 * 10 * 10);
    EXPECT_GT(value(found, "dig_triangles"), 2 * 5);
  }
}

TEST_P(Compared, TakesTheEventOfTheTree) {
  const Record found = measure(GetParam(), "canyon", 0, 96);
  const bool editable = representation(GetParam()).traits.editable, tree = GetParam() == "ght";
  EXPECT_EQ(value(found, "rebuilt"), editable ? 0 : 1);
  EXPECT_EQ(value(found, "event_rebuilt"), editable || tree ? 0 : 1);
  EXPECT_GT(value(found, "event_triangles"), 0);
  EXPECT_NE(found.find("event_bytes"), nullptr);
  // A type that did nothing would have 1. The radius is 6 cells, for the tree 8. Drills and the kernel of the
  // implicit surface are coarser than cells.
  const bool coarse = GetParam() == "drill" || GetParam() == "implicit";
  EXPECT_GT(value(found, "event_misplaced"), 0);
  EXPECT_LT(value(found, "event_misplaced"), tree ? 0.1 : coarse ? 0.5 : 0.25);
}

// On low ground the sphere, at most half the relief, could lie between the samples.
TEST(ComparedSpheres, AreNotDugIntoGroundLowerThanItsCells) {
  for (const auto& [highest, edits] : {std::pair{"150", false}, std::pair{"250", true}}) {
    const std::filesystem::path file =
        std::filesystem::path(testing::TempDir()) / fmt::format("{}_m.asc", highest);
    std::string text = "ncols 33\nnrows 33\nxllcorner 0\nyllcorner 0\ncellsize 100\n";
    for (int i = 0; i < 33 * 33; ++i) text += i == 16 * 33 + 16 ? std::string(highest) + " " : "0 ";
    write_file(file, std::string_view(text));
    const Record found = measure("layered_stack", file.string());
    EXPECT_EQ(found.find("dig_triangles") != nullptr, edits) << highest;
    EXPECT_EQ(found.find("event_triangles") != nullptr, edits) << highest;
    EXPECT_NE(found.find("triangles"), nullptr);
    std::filesystem::remove(file);
  }
}

TEST(ComparedSpheres, AreDugIntoTreesBuiltAgainWithTheColumnsOfTheScene) {
  const Record found = measure("ght", "canyon", 0, 96);
  EXPECT_EQ(value(found, "rebuilt"), 1);
  // No sample of the tree of events is left: all triangles are new, two per square of the top and of the
  // floor and per edge of the border.
  EXPECT_EQ(value(found, "dig_triangles"), 4 * 95 * 95 + 2 * 4 * 95);
  // The tree with the sphere filled is built alike.
  EXPECT_LT(value(found, "fill_triangles"), 0.1 * value(found, "triangles"));
  EXPECT_GT(value(found, "fill_triangles"), 0);
}

TEST_P(Compared, TimesEditsOftenEnoughForIntervals) {
  const Record found = measure(GetParam(), "fractal");
  for (const char* const metric : {"dig_time", "fill_time", "event_time"}) {
    ASSERT_NE(found.find(metric), nullptr) << metric;
    EXPECT_GE(found.find(metric)->samples.size(), 5U) << metric;
    EXPECT_GT(std::ranges::min(found.find(metric)->samples), 0) << metric;
  }
  for (const char* const metric : {"dig_bytes", "fill_bytes", "event_bytes", "event_triangles"}) {
    EXPECT_EQ(found.find(metric)->samples.size(), 1U) << metric;
  }
}

TEST(ComparedEvents, HaveTheSameTrianglesWhereverHeightsAreKept) {
  // On open ground the tree's event leaves the heights that a heightmap without it has.
  const Record tree = measure("ght", "fractal", 0), heights = measure("heightmap", "fractal", 0);
  EXPECT_EQ(value(tree, "event_triangles"), value(heights, "event_triangles"));
  EXPECT_EQ(value(tree, "event_rebuilt"), 0);
  EXPECT_EQ(value(heights, "event_rebuilt"), 0);
}

TEST(ComparedEvents, AreRefusedByTreesOfSolids) {
  const Record tree = measure("ght", "caves", 0), stack = measure("layered_stack", "caves", 0);
  EXPECT_EQ(value(tree, "event_rebuilt"), 1);
  EXPECT_EQ(value(stack, "event_rebuilt"), 0);
}

TEST(NewTriangles, AreThoseWithAnotherCorner) {
  TriangleMesh before;
  before.positions = {{0, 0, 0}, {1, 0, 0}, {0, 0, 1}, {1, 0, 1}, {2, 0, 0}, {2, 0, 1}};
  before.indices = {0, 2, 1, 1, 2, 3, 1, 3, 4, 4, 3, 5};
  EXPECT_EQ(new_triangles(before, before), 0U);
  EXPECT_EQ(new_triangles({}, before), 4U);
  EXPECT_EQ(new_triangles(before, {}), 0U);
  TriangleMesh after = before;
  after.indices = {3, 4, 1, 2, 1, 0, 5, 4, 3, 3, 1, 2};  // from other corners on, in another order
  EXPECT_EQ(new_triangles(before, after), 0U);
  std::swap(after.indices[0], after.indices[1]);  // turned over
  EXPECT_EQ(new_triangles(before, after), 1U);
  after = before;
  after.positions[4].y = 0x1p-20F;
  EXPECT_EQ(new_triangles(before, after), 2U);
}

// Lines through the canyon's tunnel on which at least 100 m of air lie between two solid parts.
std::size_t arched(const GroundLines& at, const LineParts& parts) {
  std::size_t lines = 0;
  for (std::size_t c = 0; c < parts.lines(); ++c) {
    const bool inside = at.x[c] > 9300 && at.x[c] < 11000 && std::abs(at.z[c] - 5760) < 400;
    const auto line = parts.line(c);
    lines += inside && line.size() == 2 && line[1].bottom - line[0].top > 100;
  }
  return lines;
}

TEST(Canyon, HasAnArchInAllSolidTypesAtEverySize) {
  Progress silent;
  for (const int resolution : {128, 256}) {
    const Scene& ground = scene({"canyon", 257, resolution, 149, 1}, silent);
    const std::size_t expected = arched(ground.lines, ground.lines.parts);
    EXPECT_GT(expected, 50U);
    for (const RepresentationType& type : representations()) {
      SCOPED_TRACE(fmt::format("{} at {}", type.name, resolution));
      const auto built = type.build(ground.source, ground.parameters(type, resolution), silent);
      const std::size_t found = arched(ground.lines, lines_of(*built, ground.lines));
      if (type.traits.overhangs && type.name != "procedural_mesh") {
        // The implicit surface's kernel, two columns wide, closes what is thin at the tunnel's mouths.
        const double share = type.name == "implicit" ? 0.25 : 0.1;
        EXPECT_NEAR(static_cast<double>(found), static_cast<double>(expected), share * expected);
      } else {
        EXPECT_EQ(found, 0U);
      }
    }
  }
}

}  // namespace
}  // namespace terrabench::cross
