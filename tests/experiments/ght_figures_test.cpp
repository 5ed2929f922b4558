#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <set>

#include "experiments/ght/event_views.h"
#include "experiments/ght/events.h"
#include "experiments/ght/ght.h"
#include "representations/ght/invariants.h"
#include "terrain/events/event.h"
#include "terrain/events/scripts.h"
#include "terrain/files.h"
#include "tests/terrain/temporary_folder.h"

namespace terrabench::ght {
namespace {

std::filesystem::path draw(const Case& at, const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder / "figures");
  Record record;
  record.profile = "quick";
  record.case_name = at.name;
  Recorder recorder(record, folder);
  Progress progress;
  draw_event_figure(at, {}, recorder, progress);
  EXPECT_EQ(record.figures.size(), 1U);
  EXPECT_EQ(record.figures.at(0).id, "ght." + at.name);
  return folder / record.figures.at(0).file;
}

class EventFigure : public testing::TestWithParam<std::size_t> {};
INSTANTIATE_TEST_SUITE_P(Ght, EventFigure, testing::Range(std::size_t{0}, event_figure_cases({}).size()));

TEST_P(EventFigure, IsDrawnAndNotBlank) {
  const TemporaryFolder folder;
  const std::filesystem::path png = draw(event_figure_cases({})[GetParam()], folder.path());
  const Image image = read_png(png);
  std::set<Rgb> colours;
  std::size_t inked = 0;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      colours.insert(image.pixel(x, y));
      inked += image.pixel(x, y) != Rgb{255, 255, 255};
    }
  }
  EXPECT_GT(colours.size(), 20U);
  EXPECT_GT(inked, image.rgb.size() / 3 / 50);
  EXPECT_LT(std::filesystem::file_size(png), 700'000U);
}

TEST(EventFigures, AreTheSameEveryTime) {
  const TemporaryFolder folder;
  for (const Case& at : event_figure_cases({})) {
    if (at.name != "F15") continue;
    EXPECT_EQ(read_file(draw(at, folder.path() / "a")), read_file(draw(at, folder.path() / "b"))) << at.name;
  }
}

TEST(EventFigures, OfListingsOfCodeAreRefused) {
  Case at = event_figure_cases({})[0];
  at.parameters.set("figure", std::int64_t{16});
  Record record;
  Recorder recorder(record, {});
  Progress progress;
  EXPECT_THROW(draw_event_figure(at, {}, recorder, progress), Error);
}

TEST(Scripts, MakeSoundTrees) {
  for (const char* const name : {"linear-erosion", "radial-erosion", "normal-fault", "inverse-fault",
                                 "lateral-fault", "tunnel", "cave", "two-tunnels", "canyon"}) {
    const Ght ght = open_tree(name);
    EXPECT_EQ(broken_invariants(ght.model()), std::vector<std::string>{}) << name;
    EXPECT_FALSE(ght.model().tree.events().empty()) << name;
    EXPECT_TRUE(open_tree(name, false).model().tree.events().empty()) << name;
  }
  EXPECT_THROW(events::script_text("tunel"), Error);
}

TEST(Scripts, TheCanyonHasHeightmapsOnHeightmaps) {
  const Ght ght = open_tree("canyon");
  std::uint32_t deepest = 0;
  for (const GroundedHeightmap& node : ght.model().tree.nodes()) deepest = std::max(deepest, node.depth);
  EXPECT_GE(deepest, 2U);
}

Ght level_ground() { return {{9, 9, 10, 10, 0, 0}, std::vector<float>(81, 5.0F), -20}; }

double plan_area(const TriangleMesh& mesh) {
  double doubled = 0;
  for (std::size_t t = 0; t < mesh.triangles(); ++t) {
    const glm::vec3 a = mesh.positions[mesh.indices[3 * t]], b = mesh.positions[mesh.indices[3 * t + 1]],
                    c = mesh.positions[mesh.indices[3 * t + 2]];
    doubled += (b.z - a.z) * (c.x - a.x) - (b.x - a.x) * (c.z - a.z);
  }
  return doubled / 2;
}

TEST(TreeView, CutsKeepWhatLiesBehindThem) {
  TreeSurface surface = tree_surface(level_ground().model());
  EXPECT_NEAR(plan_area(surface.mesh), 6400, 1e-3);
  cut_away(surface.mesh, {{33, 0}, {1, 0}}, &surface.nodes);
  EXPECT_NEAR(plan_area(surface.mesh), 33 * 80, 1e-2);
  EXPECT_EQ(surface.nodes.size(), surface.mesh.triangles());
  cut_away(surface.mesh, {{0, 0}, {1, 0}}, &surface.nodes);
  EXPECT_NEAR(plan_area(surface.mesh), 0, 1e-3);
}

TEST(TreeView, SectionsShowTheGroundAndItsHollows) {
  const auto area = [](const TriangleMesh& mesh) {
    double sum = 0;
    for (std::size_t q = 0; q + 3 < mesh.positions.size(); q += 4) {
      const glm::vec3 along = mesh.positions[q + 1] - mesh.positions[q];
      sum += std::hypot(along.x, along.z) * (mesh.positions[q + 2].y - mesh.positions[q].y);
    }
    return sum;
  };
  Ght ght = level_ground();
  const CutPlane plane{{40, 40}, {0, 1}};
  EXPECT_NEAR(area(section_face(ght, plane, 0.1F)), 80 * 25, 60);  // 2 % of overlap, and the last strip
  ght.apply(events::RadialErosion{{40, 5, 40}, {20, 15, 20}});
  // Half an ellipse with its corners cut off by the samples.
  EXPECT_NEAR(area(section_face(ght, plane, 0.1F)), 80 * 25 - 0.9 * 3.14159 / 2 * 20 * 15, 90);
}

TEST(TreeView, PlanesAreDrawnAroundTheirCells) {
  Ght ght = level_ground();
  ght.apply(events::LinearErosion{{38, 40}, {42, 40}, 8, 60});
  const Tree& tree = ght.model().tree;
  ASSERT_EQ(tree.nodes().size(), 5U);
  EXPECT_EQ(plane_outline(tree, 0).size(), 4U);
  for (const NodeId side : {1U, 2U}) EXPECT_EQ(plane_outline(tree, side).size(), 4U);
  for (const NodeId end : {3U, 4U}) EXPECT_EQ(plane_outline(tree, end).size(), 3U);
  float lowest = 0;
  for (const glm::vec3 corner : plane_outline(tree, 1)) lowest = std::min(lowest, corner.y);
  EXPECT_NEAR(lowest, -8, 1e-4);
}

}  // namespace
}  // namespace terrabench::ght
