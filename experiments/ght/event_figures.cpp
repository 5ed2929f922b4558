// Figures 13, 15 and 17 to 24 of "ght": what events make of the ground, and the table of these figures.
#include "experiments/ght/event_figures.h"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "experiments/cases.h"
#include "experiments/ght/tree_view.h"
#include "terrain/events/scripts.h"

namespace terrabench::ght {
namespace {

using namespace events;
using figures::Drawing;
using figures::Look;
using figures::Panel;
using figures::panel_sheet;
using figures::PanelRows;
using figures::Sheet;

std::vector<Panel> three_views(GlContext& gl, const Ght& ght, const Look& look, std::string_view name) {
  return {{planes_view(gl, ght, look), fmt::format("{}: ground planes", name)},
          {wires_view(gl, ght, look), "wireframe"},
          {solid_view(gl, ght, look), "solid"}};
}

// Level ground with furrows from north to south, 41 × 41 samples, 10 m apart.
Ght small_ground() {
  constexpr int kSide = 41;
  constexpr float kCell = 10;
  std::vector<float> heights;
  for (int j = 0; j < kSide; ++j) {
    for (int i = 0; i < kSide; ++i) {
      heights.push_back(6 * std::cos(0.5F * static_cast<float>(i)));
    }
  }
  return {{kSide, kSide, kCell, kCell, 0, 0}, std::move(heights), -75};
}

constexpr glm::vec3 kHigh{0.4F, 0.62F, 1.0F}, kLow{0.45F, 0.4F, 1.0F};  // kLow shows what hangs over

// Across the middle of the line of the fault in that script.
figures::CutPlane across(std::string_view script) {
  const TerrainSource source = open_named_script(script);
  const Line line = std::get<DipFault>(source.events->events.at(0)).line();
  return {glm::vec2(line.plan({line.length / 2, 0})), glm::vec2(line.along)};
}

Sheet draw_geotectonic_events(Drawing& drawing) {
  const glm::dvec2 from{110, 230}, to{290, 170};
  const std::array<std::pair<const char*, Event>, 5> events{{
      {"linear erosion", LinearErosion{from, to, 45, 38}},
      {"radial erosion", RadialErosion{{200, 10, 200}, {110, 70, 80}}},
      {"normal fault", DipFault{false, from, to, 110, 70, 60}},
      {"inverse fault", DipFault{true, from, to, 110, 70, 50}},
      {"lateral fault", LateralFault{from, to, 90, 90}},
  }};
  PanelRows rows;
  for (const auto& [name, event] : events) {
    Ght ght = small_ground();
    ght.apply(event);
    const Look look{kind(event) == Kind::kInverseFault ? kLow : kHigh, 640, 380};
    rows.push_back(three_views(drawing.gl(), ght, look, name));
  }
  return panel_sheet(rows);
}

Sheet draw_erosions(Drawing& drawing) {
  const Look look{{-0.7F, 0.9F, 0.9F}, 760, 480};
  return panel_sheet({three_views(drawing.gl(), open_tree("linear-erosion"), look, "linear erosion"),
                      three_views(drawing.gl(), open_tree("radial-erosion"), look, "radial erosion")});
}

Sheet draw_faults(Drawing& drawing) {
  PanelRows rows;
  std::vector<Panel> cuts;
  for (const char* const name : {"normal", "inverse"}) {
    const std::string script = fmt::format("{}-fault", name);
    const Ght ght = open_tree(script);
    rows.push_back(three_views(drawing.gl(), ght, {kLow, 760, 430}, fmt::format("{} fault", name)));
    cuts.push_back({solid_view(drawing.gl(), ght, {{1.0F, 0.25F, 0.6F}, 1154, 480, {across(script)}}),
                    fmt::format("{} fault, cut across its line", name)});
  }
  rows.push_back(std::move(cuts));
  return panel_sheet(rows);
}

Sheet draw_sequence(Drawing& drawing) {
  GlContext& gl = drawing.gl();
  const Look look{{0.4F, 0.7F, 1.0F}, 1060, 630};
  const Ght fresh = open_tree("canyon", false), ght = open_tree("canyon");
  const std::size_t events = ght.model().tree.events().size(), nodes = ght.model().tree.nodes().size();
  return panel_sheet({{{wires_view(gl, fresh, look), "fresh terrain, wireframe"},
                       {solid_view(gl, fresh, look), "fresh terrain, solid"}},
                      {{wires_view(gl, ght, look), fmt::format("after {} events, wireframe", events)},
                       {solid_view(gl, ght, look), fmt::format("after {} events, solid", events)}},
                      {{planes_view(gl, ght, look), fmt::format("the {} ground planes", nodes)}}});
}

// Figures 14 and 16 list code.
constexpr std::array<figures::Figure, 10> kFigures{{
    {13, "F13",
     "the shapes that geotectonic events make of level ground, as ground planes (the root's grey), wireframe "
     "and solid",
     draw_geotectonic_events},
    {15, "F15", "a tunnel and a cave carved into a ridge; on the right the ground is cut open along the axis",
     draw_carving_shapes},
    {17, "F17",
     "linear and radial erosions, each on the same fresh terrain of 129 × 129; what an event made has a "
     "colour in the wireframe",
     draw_erosions},
    {18, "F18",
     "a normal and an inverse fault, each on the same fresh terrain; the raised block of the inverse one "
     "hangs over",
     draw_faults},
    {19, "F19",
     "a tunnel carved through a terrain of 129 × 129; the views but the first are of the ground around it",
     draw_tunnel},
    {20, "F20",
     "a cave carved into a terrain of 129 × 129; the views but the first are of the ground around it",
     draw_cave},
    {21, "F21", "the part with two tunnels of a terrain of 129 × 129", draw_two_tunnels},
    {22, "F22", "a sequence of overlapping events on one terrain, and the ground planes of the tree after it",
     draw_sequence},
    {23, "F23",
     "the tree of figure 22's terrain; edges lead from each heightmap to those that an event attached to it, "
     "and cells show what they hold",
     draw_tree},
    {24, "F24",
     "a rain of particles (yellow: the first 250), each of which erodes the ground where it crashes; the "
     "mountains and the rain are those of the measurement, with 257 × 257 of its 1025 × 1025 samples and "
     "2,500 of its 10,000 particles",
     draw_rain},
}};
constexpr std::array kNames = names_of(kFigures);
const std::array kSpecs{choice("figure", kNames, "figure of the paper")};

std::vector<Case> cases(const RunOptions&) { return cases_by("figure", kSpecs); }

void draw(const Case& at, const RunOptions& options, Recorder& recorder, Progress&) {
  draw_figure(kFigures, "ght", at, options, recorder);
}

}  // namespace

Ght open_tree(std::string_view script, bool with_events) {
  const TerrainSource source = open_named_script(script);
  const Heightfield& field = source.events->ground;
  // Low enough for these events. The floor of the script's own solid allows for the worst case.
  Ght ght({field.width, field.depth, field.cell_x, field.cell_z, 0, 0}, field.heights,
          height_range(field).lowest - 3 * field.cell_x);
  if (with_events) {
    for (const Event& event : source.events->events) ght.apply(event);
  }
  return ght;
}

std::span<const figures::Figure> event_figures() { return kFigures; }

extern const Experiment kEventFigures{"ght.event-figures", "Figures 13, 15 and 17-24: events and their trees",
                                      kSpecs, cases, draw};

}  // namespace terrabench::ght
