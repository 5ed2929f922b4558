// What the figures of "ght" are made of and measured by. Claims judge the figures themselves.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "experiments/figures/ground.h"
#include "experiments/figures/views.h"
#include "experiments/ght/figures.h"
#include "experiments/ght/shown.h"
#include "experiments/ght/stage_numbers.h"
#include "experiments/ght/tree_view.h"
#include "representations/ght/invariants.h"
#include "terrain/error.h"
#include "terrain/events/scripts.h"
#include "tests/experiments/sheet_reader.h"

namespace terrabench::ght {
namespace {

using figures::cut_away;
using figures::CutPlane;
using figures::section_face;
using ::testing::Contains;
using ::testing::EndsWith;

std::vector<std::string> words(const SheetReader& shown) {
  std::vector<std::string> all;
  for (const SheetReader::Words& each : shown.words) all.push_back(each.text);
  return all;
}

TEST(GhtFigures, TreeShowsEachCellOfEachNode) {
  const Tree tree = sequence_tree(1).model().tree;
  const RunOptions options;
  figures::Drawing drawing(options);
  const SheetReader shown(draw_tree(drawing));
  ASSERT_EQ(shown.pictures.size(), tree.nodes().size());
  const std::map<CellKind, Rgb> colours{{CellKind::kHeight, {200, 200, 200}},
                                        {CellKind::kLink, {213, 94, 0}},
                                        {CellKind::kVoid, {0, 114, 178}}};
  std::map<CellKind, std::size_t> cells;
  for (NodeId n = 0; n < tree.nodes().size(); ++n) {
    const GroundedHeightmap& node = tree.nodes()[n];
    const SheetReader::Picture& picture = shown.pictures[n];
    // Where cells are under two pixels of the file, one may be drawn a pixel away.
    constexpr double kPixel = 1.0 / figures::Sheet::kPixels;
    const std::vector<double> shifts =
        picture.height / node.rows < 2 * kPixel ? std::vector{0.0, -kPixel, kPixel} : std::vector{0.0};
    std::size_t wrong = 0;
    for (int j = 0; j < node.rows; ++j) {
      for (int i = 0; i < node.columns; ++i) {
        const CellKind kind = tree.kind(node.cell(i, j));
        ++cells[kind];
        bool found = false;
        for (const double dx : shifts) {
          for (const double dy : shifts) {
            found |= shown.pixel(picture, (i + 0.5) / node.columns + dx / picture.width,
                                 (j + 0.5) / node.rows + dy / picture.height) == colours.at(kind);
          }
        }
        wrong += !found;
      }
    }
    EXPECT_EQ(wrong, 0U) << "node " << n << ", " << node.columns << " x " << node.rows;
    EXPECT_THAT(words(shown), Contains(EndsWith(fmt::format(", {} × {}", node.columns, node.rows))));
  }
  EXPECT_EQ(cells.size(), 3U);
  for (const Applied& event : tree.events()) {
    std::string name(events::name(event.kind));
    std::replace(name.begin(), name.end(), '-', ' ');
    EXPECT_THAT(words(shown), Contains(EndsWith(". " + name)));
  }
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

TEST(Trimmed, TakesAwayWhatAllPanelsLeaveWhite) {
  constexpr Rgb kWhite{255, 255, 255}, kInk{0, 0, 0};
  Image left(100, 80, kWhite), right(100, 80, kWhite);
  left.set(30, 40, kInk);
  right.set(60, 50, kInk);
  const figures::PanelRows rows = trimmed({{{left, "left"}, {right, "right"}}});
  for (const figures::Panel& panel : rows[0]) {
    EXPECT_EQ(panel.image.width, 60 - 30 + 1 + 2 * 8 + 1);  // to be even
    EXPECT_EQ(panel.image.height, 50 - 40 + 1 + 2 * 8 + 1);
  }
  EXPECT_EQ(rows[0][0].image.pixel(8, 8), kInk);
  EXPECT_EQ(rows[0][1].image.pixel(8 + 30, 8 + 10), kInk);
}

// The numbers that checks of figures read must be others where the figure is another.
TEST(StageNumbers, TellWrongDrawingsFromRightOnes) {
  EXPECT_EQ(different(std::vector{3, 1, 3}), 2);
  EXPECT_EQ(moved_points({0, 1}, {0, 5, 1}), 0);
  EXPECT_EQ(moved_points({0, 2, 1}, {0, 5, 2, 5, 2}), 1);
  EXPECT_EQ(mean_displacement({0, 3, 0, -1, 0}, 1), 0);
  EXPECT_EQ(mean_displacement({0, 3, 0, -1, 0}, 2), 2);
  EXPECT_EQ(neighbours_among({{1, 1}, {3, 1}, {3, 3}, {1, 3}}, {2, 2}, true), 4);
  EXPECT_EQ(neighbours_among({{1, 1}, {3, 1}, {3, 3}, {1, 3}}, {2, 2}, false), 0);
  EXPECT_EQ(neighbours_among({{0, 1}, {1, 2}, {0, 3}, {3, 2}}, {4, 2}, false), 4) << "across the border";
  EXPECT_EQ(neighbours_among({{0, 1}, {1, 2}, {0, 3}, {4, 1}}, {0, 2}, false), 3) << "one point twice";
  Heightfield bump = Heightfield::zeros(5, 5);
  bump.at(4, 2) = 1;
  EXPECT_EQ(raised_within(bump, 2, 2), 2);
  const TriangleMesh half = figures::ground_mesh(every_other(bump));
  EXPECT_NEAR(correlation(figures::heightmap_image(bump), half, 1), 1, 1e-9);
  EXPECT_EQ(correlation(figures::heightmap_image(Heightfield::zeros(5, 5)), half, 1), 0);
}

TEST(Shown, ChangesAreThoseOfTheEvent) {
  const Ght before = level_ground();
  Ght after = before;
  after.apply(events::RadialErosion{{40, 5, 40}, {20, 15, 20}});
  const Change none = change(before, before), bowl = change(before, after);
  EXPECT_EQ(none.removed + none.added + none.deepest + none.highest + none.overhang, 0);
  EXPECT_GT(bowl.removed, 1000);
  EXPECT_EQ(bowl.added, 0);
  EXPECT_NEAR(bowl.deepest, 15, 1);
  const Change back = change(after, before);
  EXPECT_EQ(back.added, bowl.removed);
  EXPECT_EQ(planes_of_events(after), 1);
}

TEST(Shown, ATunnelIsOpenOnlyWhereItIsCarved) {
  const Ght before = open_tree("two-tunnels", false), after = open_tree("two-tunnels");
  const std::vector<events::Event> tunnels = events::open_named_script("two-tunnels").events->events;
  EXPECT_EQ(open_tunnels(before, after, tunnels), 2);
  EXPECT_EQ(open_tunnels(before, before, tunnels), 0);
  EXPECT_EQ(open_tunnels(before, open_tree("tunnel"), tunnels), 1);
}

TEST(Shown, SkyIsWhatIsAboveTheWires) {
  Image wires(20, 40, {255, 255, 255}), textured(20, 40, {90, 120, 200});
  for (int x = 0; x < 20; ++x) {
    wires.set(x, 20, {0, 0, 0});
    for (int y = 20; y < 40; ++y) textured.set(x, y, {120, 110, 60});
  }
  EXPECT_EQ(blueness(wires, textured).sky, 1);
  EXPECT_EQ(blueness(wires, textured).ground, 0);
  EXPECT_EQ(blueness(wires, wires).sky, 0);
  EXPECT_EQ(blue_share(wires), 0);
  EXPECT_EQ(yellow_share(Image(2, 2, {240, 200, 20})), 1);
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
