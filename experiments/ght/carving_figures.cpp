// Figures 15 and 19 to 21 of "ght": tunnels and caves, and the ground cut open along their axes.
#include <glm/geometric.hpp>

#include "experiments/ght/events.h"
#include "renderers/scene.h"
#include "terrain/events/event.h"
#include "terrain/events/scripts.h"

namespace terrabench::ght {
namespace {

using namespace events;

// Along the axis, away from what looks at it; a hundredth of a section beside it, so that no corner lies in
// the plane.
CutPlane along(const Carving& carving, glm::vec3 from) {
  const Line line = carving.line();
  glm::dvec2 towards = line.left;
  if (glm::dot(towards, glm::dvec2(from.x, from.z)) < 0) towards = -towards;
  return {glm::vec2(line.origin + 1.7 * towards), glm::vec2(towards)};
}

// A ridge across 61 samples of 10 m.
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

std::vector<Panel> four_views(GlContext& context, const Ght& ght, const Carving& carving, const Look& look) {
  Look open = look;
  open.cuts.push_back(along(carving, look.from));
  return {{planes_view(context, ght, look), "ground planes"},
          {wires_view(context, ght, look), "wireframe"},
          {solid_view(context, ght, look), "solid"},
          {solid_view(context, ght, open), "solid, cut along the axis"}};
}

// The ridge with the carvings and the valleys on both its sides, out of the whole terrain.
std::vector<CutPlane> around_the_ridge(const Ght& ght) {
  const SampleGrid& grid = ght.model().tree.grid();
  return {{{grid.x(49), 0}, {-1, 0}},
          {{grid.x(111), 0}, {1, 0}},
          {{0, grid.z(28)}, {0, -1}},
          {{0, grid.z(73)}, {0, 1}}};
}

// Two by two.
void write_four(std::vector<Panel> views, const std::filesystem::path& png) {
  write_panels({{views[0], views[1]}, {views[2], views[3]}}, png);
}

void draw_single(GlContext& context, const char* script, const std::filesystem::path& png) {
  const TerrainSource source = open_named_script(script);
  const Ght ght = open_tree(script);
  const Look look{{0.8F, 0.4F, 1.0F}, 1000, 560, around_the_ridge(ght)};
  write_four(four_views(context, ght, std::get<Carving>(source.events->events.at(0)), look), png);
}

}  // namespace

void draw_carving_shapes(GlContext& context, Recorder& recorder) {
  const Look look{{0.55F, 0.4F, 1.0F}, 760, 440, {}};
  const glm::dvec3 east{390, 55, 200};
  std::vector<std::vector<Panel>> rows;
  for (const bool cave : {false, true}) {
    const Carving carving{cave, east, {cave ? 270.0 : 210.0, 55, 200}, vault(), 1, cave ? 1.2 : 1, 0, 0};
    Ght ght = ridge();
    ght.apply(carving);
    std::vector<Panel> views = four_views(context, ght, carving, look);
    views.erase(views.begin() + 1);
    views[0].words = cave ? "cave: ground planes" : "tunnel: ground planes";
    rows.push_back(std::move(views));
  }
  write_panels(rows,
               recorder.figure("ght.F15", "png",
                               "Figure 15 of the paper: a tunnel and a cave carved into a ridge; on the "
                               "right the ground is cut open along the axis"));
}

void draw_tunnel(GlContext& context, Recorder& recorder) {
  draw_single(context, "tunnel",
              recorder.figure(
                  "ght.F19", "png",
                  "Figure 19 of the paper: a tunnel carved through a terrain of 129 × 129; the views but the "
                  "first are of the ground around it"));
}

void draw_cave(GlContext& context, Recorder& recorder) {
  draw_single(
      context, "cave",
      recorder.figure("ght.F20", "png",
                      "Figure 20 of the paper: a cave carved into a terrain of 129 × 129; the views but the "
                      "first are of the ground around it"));
}

void draw_two_tunnels(GlContext& context, Recorder& recorder) {
  const Ght ght = open_tree("two-tunnels");
  const Look look{{0.9F, 0.45F, 1.0F}, 1060, 620, around_the_ridge(ght)};
  write_panels(
      {{{wires_view(context, ght, look), "wireframe"}, {solid_view(context, ght, look), "solid"}}},
      recorder.figure("ght.F21", "png",
                      "Figure 21 of the paper: the part with two tunnels of a terrain of 129 × 129"));
}

}  // namespace terrabench::ght
