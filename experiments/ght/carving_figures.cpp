// Figures 15 and 19 to 21 of "ght": tunnels and caves, and the ground cut open along their axes.
#include <glm/geometric.hpp>

#include "experiments/ght/event_figures.h"
#include "experiments/ght/tree_view.h"
#include "terrain/events/scripts.h"

namespace terrabench::ght {
namespace {

using namespace events;
using figures::CutPlane;
using figures::Drawing;
using figures::Look;
using figures::Panel;
using figures::panel_sheet;
using figures::Sheet;

// Along the axis, so that the ground towards `from` goes; 1.7 m beside the axis, so that no corner of the
// section lies in the plane.
CutPlane along(const Carving& carving, glm::vec3 from) {
  const Line line = carving.line();
  glm::dvec2 towards = line.left;
  if (glm::dot(towards, glm::dvec2(from.x, from.z)) < 0) towards = -towards;
  return {glm::vec2(line.origin + 1.7 * towards), glm::vec2(towards)};
}

// A ridge from north to south; 61 × 41 samples, 10 m apart.
Ght ridge() {
  constexpr int kWide = 61, kDeep = 41;
  constexpr float kCell = 10;
  std::vector<float> heights;
  for (int j = 0; j < kDeep; ++j) {
    for (int i = 0; i < kWide; ++i) {
      const float x = (static_cast<float>(i) - 30) / 14, z = (static_cast<float>(j) - 20) / 30;
      heights.push_back(170 * std::exp(-x * x) * (1 - 0.25F * z * z));
    }
  }
  return {{kWide, kDeep, kCell, kCell, 0, 0}, std::move(heights), -60};
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
std::vector<CutPlane> around_the_ridge(const Ght& ght) { return around(ght, {49, 28}, {111, 73}); }

Sheet draw_single(Drawing& drawing, const char* script) {
  const TerrainSource source = open_named_script(script);
  const Ght ght = open_tree(script);
  const Look look{{0.8F, 0.4F, 1.0F}, 1000, 560, around_the_ridge(ght)};
  const auto& carving = std::get<Carving>(source.events->events.at(0));
  return panel_sheet(figures::in_rows_of(2, four_views(drawing.gl(), ght, carving, look)));
}

}  // namespace

Sheet draw_carving_shapes(Drawing& drawing) {
  const Look look{{0.55F, 0.4F, 1.0F}, 760, 440};
  const glm::dvec3 east{390, 55, 200};
  figures::PanelRows rows;
  for (const bool cave : {false, true}) {
    const Carving carving{cave, east, {cave ? 270.0 : 210.0, 55, 200}, vault(), 1, cave ? 1.2 : 1, 0, 0};
    Ght ght = ridge();
    ght.apply(carving);
    std::vector<Panel> views = four_views(drawing.gl(), ght, carving, look);
    views.erase(views.begin() + 1);
    views[0].words = cave ? "cave: ground planes" : "tunnel: ground planes";
    rows.push_back(std::move(views));
  }
  return panel_sheet(rows);
}

Sheet draw_tunnel(Drawing& drawing) { return draw_single(drawing, "tunnel"); }

Sheet draw_cave(Drawing& drawing) { return draw_single(drawing, "cave"); }

Sheet draw_two_tunnels(Drawing& drawing) {
  const Ght ght = open_tree("two-tunnels");
  const Look look{{0.9F, 0.45F, 1.0F}, 1060, 620, around_the_ridge(ght)};
  return panel_sheet(
      {{{wires_view(drawing.gl(), ght, look), "wireframe"}, {solid_view(drawing.gl(), ght, look), "solid"}}});
}

}  // namespace terrabench::ght
