// Figures 13, 15 and 17 to 24 of "ght": what events make of the ground, and the table of these figures.
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "experiments/ght/figures.h"
#include "experiments/ght/shown.h"
#include "experiments/ght/site.h"
#include "experiments/ght/tree_view.h"
#include "renderers/landscape/style.h"
#include "results/store/format.h"
#include "terrain/events/scripts.h"

namespace terrabench::ght {
namespace {

using namespace events;
using figures::CutPlane;
using figures::Drawing;
using figures::Look;
using figures::Panel;
using figures::panel_sheet;
using figures::PanelRows;
using figures::Sheet;

// Ground planes are seen from higher up than the ground, as some rise away from the eye and would be slivers;
// those of an inverse fault from less high, as one faces down.
constexpr float kAbove = 1.5F, kAboveOverhang = 0.72F;

std::vector<Panel> three_views(GlContext& gl, const Ght& ght, const Look& look, std::string_view name,
                               float planes_from = kAbove) {
  Look higher = look;
  higher.from.y = planes_from;
  return {{planes_view(gl, ght, higher), fmt::format("{}: ground planes", name)},
          {wires_view(gl, ght, look), "wireframe"},
          {solid_view(gl, ght, look), "solid"}};
}

// Samples `cell` metres apart, height(x, z) metres high.
template <class Height>
Ght small_ground(int wide, int deep, float cell, float floor, const Height& height) {
  std::vector<float> heights;
  for (int j = 0; j < deep; ++j) {
    for (int i = 0; i < wide; ++i) {
      heights.push_back(height(cell * static_cast<float>(i), cell * static_cast<float>(j)));
    }
  }
  return {{wide, deep, cell, cell, 0, 0}, std::move(heights), floor};
}
Ght level_ground() {
  return small_ground(41, 41, 10, -75, [](float, float) { return 0.0F; });
}
// Level but for furrows from north to south.
Ght furrows() {
  return small_ground(41, 41, 10, -75, [](float x, float) { return 6 * std::cos(0.05F * x); });
}
// A ridge from north to south.
Ght ridge() {
  return small_ground(121, 81, 5, -60, [](float x, float z) {
    const float across = (x - 300) / 140, along = (z - 200) / 300;
    return 170 * std::exp(-across * across) * (1 - 0.25F * along * along);
  });
}

constexpr int kSequenceSide = 128;  // cells, as the measurement of ght.complex

constexpr glm::vec3 kHigh{0.4F, 0.62F, 1.0F},
    kLow{0.45F, 0.4F, 1.0F};  // towards the eye; kLow looks under overhangs

Event event_of(std::string_view script) { return open_named_script(script).events->events.at(0); }

// Across the middle of the line of the fault in that script.
CutPlane across(std::string_view script) {
  const Line line = std::get<DipFault>(event_of(script)).line();
  return {glm::vec2(line.plan({line.length / 2, 0})), glm::vec2(line.along)};
}

Sheet draw_geotectonic_events(Drawing& drawing) {
  const glm::dvec2 from{110, 230}, to{290, 170};
  const std::array<std::pair<const char*, Event>, 5> events{{
      {"linear erosion", LinearErosion{from, to, 45, 38}},
      {"radial erosion", RadialErosion{{200, 0, 200}, {110, 60, 80}}},
      {"normal fault", DipFault{false, from, to, 110, 70, 60}},
      {"inverse fault", DipFault{true, from, to, 110, 70, 50}},
      {"lateral fault", LateralFault{from, to, 90, 90}},
  }};
  PanelRows rows;
  for (const auto& [name, event] : events) {
    const Ght fresh = kind(event) == Kind::kLateralFault ? furrows() : level_ground();
    Ght ght = fresh;
    ght.apply(event);
    const bool overhangs = kind(event) == Kind::kInverseFault;
    rows.push_back(three_views(drawing.gl(), ght, {overhangs ? kLow : kHigh, 700, 480}, name,
                               overhangs ? kAboveOverhang : kAbove));
    record_event(drawing, event, fresh, ght, rows.back()[1].image);
  }
  return panel_sheet(trimmed(rows));
}

Sheet draw_erosions(Drawing& drawing) {
  const Look look{{-0.7F, 0.9F, 0.9F}, 760, 480};
  PanelRows rows;
  for (const char* const name : {"linear", "radial"}) {
    const std::string script = fmt::format("{}-erosion", name);
    const Ght fresh = open_tree(script, false), ght = open_tree(script);
    rows.push_back(three_views(drawing.gl(), ght, look, fmt::format("{} erosion", name)));
    record_event(drawing, event_of(script), fresh, ght, rows.back()[1].image);
  }
  return panel_sheet(trimmed(rows));
}

Sheet draw_faults(Drawing& drawing) {
  PanelRows rows;
  std::vector<Panel> cuts;
  for (const char* const name : {"normal", "inverse"}) {
    const std::string script = fmt::format("{}-fault", name);
    const Ght ght = open_tree(script);
    rows.push_back(three_views(drawing.gl(), ght, {kLow, 760, 480}, fmt::format("{} fault", name),
                               script == "inverse-fault" ? kAboveOverhang : kAbove));
    record_event(drawing, event_of(script), open_tree(script, false), ght, rows.back()[1].image);
    cuts.push_back({solid_view(drawing.gl(), ght, {{1.0F, 0.25F, 0.6F}, 1154, 480, {across(script)}}),
                    fmt::format("{} fault, cut across its line", name)});
  }
  rows.push_back(std::move(cuts));
  return panel_sheet(trimmed(rows));
}

Sheet draw_sequence(Drawing& drawing) {
  GlContext& gl = drawing.gl();
  const Look look{{0.4F, 0.7F, 1.0F}, 1060, 720};
  const Site site = event_site(kSequenceSide, kSequenceSide / kEventsAlong, drawing.seed());
  const Ght fresh = plain_tree(site.ground), ght = sequence_tree(drawing.seed());
  const std::size_t events = ght.model().tree.events().size(), nodes = ght.model().tree.nodes().size();
  drawing.record("events", static_cast<double>(events));
  drawing.record("heightmaps", static_cast<double>(nodes));
  drawing.record("planes", 1 + planes_of_events(ght));
  const Image before = wires_view(gl, fresh, look), after = wires_view(gl, ght, look);
  drawing.record("blue_before", blue_share(before));
  drawing.record("blue_after", blue_share(after));
  return panel_sheet(
      trimmed({{{before, "fresh terrain, wireframe"}, {solid_view(gl, fresh, look), "fresh terrain, solid"}},
               {{after, fmt::format("after {} events, wireframe", events)},
                {solid_view(gl, ght, look), fmt::format("after {} events, solid", events)}},
               {{planes_view(gl, ght, look), fmt::format("the {} ground planes", nodes)}}}));
}

// Figures 15 and 19 to 21: tunnels and caves, and the ground cut open along their axes.

// A cut along the axis that removes the ground on the side of the eye (`from`); 1.7 m beside the axis, so
// that no corner of the section lies in the plane.
CutPlane along(const Carving& carving, glm::vec3 from) {
  const Line line = carving.line();
  glm::dvec2 towards = line.left;
  if (glm::dot(towards, glm::dvec2(from.x, from.z)) < 0) towards = -towards;
  return {glm::vec2(line.origin + 1.7 * towards), glm::vec2(towards)};
}

std::vector<glm::dvec2> vault() { return {{-28, -24}, {28, -24}, {34, 6}, {20, 30}, {-20, 30}, {-34, 6}}; }

std::vector<Panel> four_views(GlContext& gl, const Ght& ght, const Carving& carving, const Look& look) {
  Look open = look;
  open.cuts.push_back(along(carving, look.from));
  return {{planes_view(gl, ght, look), "ground planes"},
          {wires_view(gl, ght, look), "wireframe"},
          {solid_view(gl, ght, look), "solid"},
          {solid_view(gl, ght, open), "solid, cut along the axis"}};
}

// The ridge with the carvings and the valleys on both sides of it.
std::vector<CutPlane> around_the_ridge(const Ght& ght) { return around(ght, {66, 34}, {108, 66}); }

Sheet draw_single(Drawing& drawing, const char* script) {
  const Ght ght = open_tree(script);
  const Look look{{0.8F, 0.4F, 1.0F}, 1000, 560, around_the_ridge(ght)};
  const auto carving = std::get<Carving>(event_of(script));
  record_carving(drawing, carving, open_tree(script, false), ght);
  return panel_sheet(trimmed(figures::in_rows_of(2, four_views(drawing.gl(), ght, carving, look))));
}

Sheet draw_carving_shapes(Drawing& drawing) {
  const Look look{{0.85F, 0.42F, 0.9F}, 760, 500};
  const glm::dvec3 east{390, 55, 200};
  PanelRows rows;
  for (const bool cave : {false, true}) {
    const Carving carving{cave, east, {cave ? 270.0 : 210.0, 55, 200}, vault(), 1, cave ? 1.2 : 1, 0, 0};
    const Ght fresh = ridge();
    Ght ght = fresh;
    ght.apply(carving);
    record_carving(drawing, carving, fresh, ght);
    std::vector<Panel> views = four_views(drawing.gl(), ght, carving, look);
    views.erase(views.begin() + 1);
    views[0].words = cave ? "cave: ground planes" : "tunnel: ground planes";
    rows.push_back(std::move(views));
  }
  return panel_sheet(trimmed(rows));
}

// From the valley before the ridge.
View before_the_tunnels() {
  View view;
  view.eye = {14200, 1900, 8600};
  view.target = {10300, 850, 6250};
  view.vertical_fov = 0.66F;
  view.width = 1000;
  view.height = 620;
  view.near = 20;
  view.far = 60000;
  return view;
}

Sheet draw_two_tunnels(Drawing& drawing) {
  const Ght ght = open_tree("two-tunnels");
  const View view = before_the_tunnels();
  const Parameters style(landscape_parameters(), {{"water", 0.0},
                                                  {"texture", 120.0},
                                                  {"bumps", 0.35},
                                                  {"fog", 2.5},
                                                  {"border", 0.0},
                                                  {"sun_height", 40.0}});
  const Image wires = wires_view(drawing.gl(), ght, view),
              textured = textured_view(drawing.gl(), ght, view, style);
  drawing.record("open_tunnels", open_tunnels(open_tree("two-tunnels", false), ght,
                                              open_named_script("two-tunnels").events->events));
  const Blueness blue = blueness(wires, textured);
  drawing.record("blue_sky", blue.sky);
  drawing.record("blue_ground", blue.ground);
  return panel_sheet({{{wires, "wireframe"}, {textured, "textured, under a sky"}}});
}

// Figure 24: the rain of particles (§4.2), as ght.complex measures it.

// A quarter of the measurement's samples along each side, which show at this size.
constexpr int kSide = 256, kParticles = 2500, kDrawn = 250;

// Octahedra over the places that the next particles will hit, at several heights.
TriangleMesh falling(const Ght& ght, Rain rain) {
  const float width = ght.bounds().size().x, size = 0.008F * width;
  TriangleMesh mesh;
  for (int k = 0; k < kDrawn; ++k) {
    glm::vec3 centre(std::get<RadialErosion>(rain.next(ght)).centre);
    const float turns = 0.618F * static_cast<float>(k);  // the golden ratio spreads its fractions evenly
    centre.y += width * (0.01F + 0.24F * (turns - std::floor(turns)));
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (const glm::vec3 corner :
         {glm::vec3(1, 0, 0), {0, 0, -1}, {-1, 0, 0}, {0, 0, 1}, {0, 1, 0}, {0, -1, 0}}) {
      mesh.positions.push_back(centre + size * corner);
    }
    for (std::uint32_t side = 0; side < 4; ++side) {
      const std::uint32_t next = (side + 1) % 4;
      mesh.indices.insert(mesh.indices.end(), {first + side, first + next, first + 4});
      mesh.indices.insert(mesh.indices.end(), {first + next, first + side, first + 5});
    }
  }
  return mesh;
}

Sheet draw_rain(Drawing& drawing) {
  GlContext& gl = drawing.gl();
  const Site site = event_site(kSide, kSide / kEventsAlong, drawing.seed());
  Ght ght = plain_tree(site.ground);
  Rain rain(site.ground, drawing.seed());
  const Look look{{0.45F, 0.7F, 1.0F}, 820, 600};
  Look window = look;
  window.cuts = around(ght, {96, 96}, {160, 160});
  const TriangleMesh particles = falling(ght, rain);
  Bounds box = ght.bounds();
  box.high.y = bounds_of(particles).high.y;
  const View view = look.at(box);
  const Parameters style(landscape_parameters(), {{"water", 0.0},
                                                  {"texture", 200.0},
                                                  {"bumps", 0.5},
                                                  {"fog", 1000.0},
                                                  {"border", 0.0},
                                                  {"sun_height", 35.0}});
  const auto record = [&](const char* when, const std::vector<Panel>& row) {
    drawing.record(fmt::format("planes_{}", when), planes_of_events(ght));
    drawing.record(fmt::format("blue_{}", when), blue_share(row[1].image));
    drawing.record(fmt::format("yellow_{}", when), yellow_share(row[2].image));
  };
  const Ght fresh = ght;
  PanelRows rows{{{planes_view(gl, ght, look), "before: ground plane"},
                  {wires_view(gl, ght, window), "wireframe, a window of 65 × 65"},
                  {textured_block(gl, ght, view, style, particles), "textured, the rain begins"}}};
  record("before", rows.back());
  for (int k = 0; k < kParticles; ++k) ght.apply(rain.next(ght));
  const auto events = static_cast<double>(ght.model().tree.events().size());
  const std::string particles_text = format_number(events);
  rows.push_back(
      {{planes_view(gl, ght, look), fmt::format("after {} particles: ground planes", particles_text)},
       {wires_view(gl, ght, window), "wireframe, the same window"},
       {textured_block(gl, ght, view, style, {}), "textured"}});
  record("after", rows.back());
  const Change shape = change(fresh, ght);
  drawing.record("particles", events);
  drawing.record("removed", shape.removed);
  drawing.record("added", shape.added);
  return panel_sheet(trimmed(rows));
}

// Figures 14 and 16 list code.
constexpr std::array<figures::Figure, 10> kFigures{{
    {13, "F13",
     "the shapes that geotectonic events make of level ground, for the lateral fault with furrows that show "
     "its "
     "slip: ground planes (the root's grey), wireframe (new heightmaps blue) and solid",
     draw_geotectonic_events},
    {15, "F15", "a tunnel and a cave carved into a ridge; on the right the ground is cut open along the axis",
     draw_carving_shapes},
    {17, "F17",
     "linear and radial erosions, each on the same fresh terrain of 129 × 129; new heightmaps are blue in "
     "the "
     "wireframe",
     draw_erosions},
    {18, "F18",
     "a normal and an inverse fault, each on the same fresh terrain; the raised block of the inverse "
     "fault overhangs the sunk one",
     draw_faults},
    {19, "F19",
     "a tunnel carved through a terrain of 129 × 129; all views but the first show only 43 × 33 samples "
     "around it",
     [](Drawing& drawing) { return draw_single(drawing, "tunnel"); }},
    {20, "F20",
     "a cave carved into a terrain of 129 × 129; all views but the first show only 43 × 33 samples around it",
     [](Drawing& drawing) { return draw_single(drawing, "cave"); }},
    {21, "F21",
     "two tunnels through a ridge in a terrain of 129 × 129, as wireframe and with textures by height and "
     "slope "
     "under a sky",
     draw_two_tunnels},
    {22, "F22",
     "a sequence of overlapping events on one terrain, the ground planes of the tree after it below; new "
     "heightmaps are blue in the wireframe",
     draw_sequence},
    {23, "F23",
     "the tree of figure 22's terrain; edges lead from each heightmap to those that events attached to it, "
     "and cells show what they hold",
     draw_tree},
    {24, "F24",
     "a rain of particles (yellow: the first 250), each of which erodes the ground where it crashes; "
     "textures "
     "by height and slope. The mountains and particles of the measurement at every fourth sample, 257 × 257 "
     "of 1025 × 1025, with 2,500 of 10,000 particles, whose craters are four times as wide in metres",
     draw_rain},
}};

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

Ght sequence_tree(std::uint64_t seed) {
  const Site site = event_site(kSequenceSide, kSequenceSide / kEventsAlong, seed);
  Ght ght = plain_tree(site.ground);
  for (const Event& event : overlapping_events(site)) ght.apply(event);
  return ght;
}

extern const Experiment kEventFigures = figures::figure_experiment<kFigures>(
    "ght.event-figures", "Figures 13, 15 and 17-24: events and their trees");

}  // namespace terrabench::ght
