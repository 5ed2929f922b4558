// Figures 1 and 3 to 10 of "ght": the generators of base terrain step by step. Here those in space, and the
// table of all.
#include <fmt/format.h>

#include <array>

#include "experiments/cases.h"
#include "experiments/figures/ground.h"
#include "experiments/figures/views.h"
#include "experiments/ght/stages.h"
#include "terrain/sources/fractal/diamond_square.h"
#include "terrain/sources/fractal/hills.h"

namespace terrabench::ght {
namespace {

using figures::Drawing;
using figures::ground_mesh;
using figures::Look;
using figures::panel_sheet;
using figures::Sheet;
using figures::wire_view;

constexpr figures::PanelStyle kStyle{.margin = 20, .words = 28, .baseline = 20, .text_size = 15};

Sheet draw_heightmap_and_wireframe(Drawing& drawing) {
  const Heightfield field = fractal::diamond_square(
      {.seed = drawing.seed(), .side = 129, .cell = 30, .amplitude = 800, .hurst = 0.9F});
  const Look look{.width = 1120, .height = 774};
  return panel_sheet({{{figures::heightmap_image(field), "heightmap, 129 × 129", 3},
                       {wire_view(drawing.gl(), ground_mesh(resample(field, 65, 65)), look, 1.2F),
                        "wireframe, every other sample"}}},
                     kStyle);
}

Sheet draw_diamond_square_terrains(Drawing& drawing) {
  std::vector<figures::Panel> panels;
  for (int n = 1; n <= 6; ++n) {
    const int side = (1 << n) + 1;
    const Heightfield field = fractal::diamond_square({.seed = drawing.seed(),
                                                       .side = side,
                                                       .cell = 3840.0F / static_cast<float>(side - 1),
                                                       .amplitude = 900,
                                                       .hurst = 0.9F});
    const Look look{.width = 660, .height = 460};
    panels.push_back({wire_view(drawing.gl(), ground_mesh(field), look, n < 5 ? 2 : 1.2F),
                      fmt::format("{} iteration{}: {} × {}", n, n == 1 ? "" : "s", side, side)});
  }
  return panel_sheet(figures::in_rows_of(3, std::move(panels)), kStyle);
}

Sheet draw_hills_one_and_many(Drawing& drawing) {
  fractal::HillOptions options{
      .seed = drawing.seed(), .width = 65, .depth = 65, .cell = 1, .hills = 60, .scale = 0.05F};
  options.least_radius = 5;
  options.most_radius = 17;
  const auto view = [&](const Heightfield& field) {
    return wire_view(drawing.gl(), ground_mesh(field), {.width = 1000, .height = 660}, 1.4F);
  };
  return panel_sheet({{{view(fractal::raise_hills(options, {{32, 32, 19}})), "one hill"},
                       {view(fractal::hill_terrain(options)), "60 hills"}}},
                     kStyle);
}

// Figure 2 shows a triangulated irregular network, which no method here makes.
constexpr std::array<figures::Figure, 9> kFigures{{
    {1, "F1", "a terrain as heightmap (black low, white high) and as wireframe seen from the south-east",
     draw_heightmap_and_wireframe},
    {3, "F3",
     "midpoint displacement of a line; the points that each step adds are blue, and its range is half of the "
     "one before",
     draw_midpoints},
    {4, "F4",
     "the four points of a square, of a diamond, and of a diamond that straddles the border; rings are the "
     "points that take their mean",
     draw_neighbourhoods},
    {5, "F5",
     "diamond-square on an array of 5 × 5; points that the step sets are black, earlier ones grey, and lines "
     "lead to the points whose mean they take",
     draw_diamond_square_steps},
    {6, "F6",
     "the diamond that straddles the border of the array gives its value to a point on either side (rings, "
     "with the height that each received)",
     draw_straddling_diamond},
    {7, "F7", "one terrain after 1 to 6 iterations of diamond-square", draw_diamond_square_terrains},
    {8, "F8",
     "the first fault divides the height field; points on its one side rise (stars), those on the other sink "
     "(crosses)",
     draw_first_fault},
    {9, "F9",
     "the height map as the number of faults grows; black is each map's lowest point, white its highest",
     draw_fault_maps},
    {10, "F10", "an isolated hill, and the terrain after 60 of them; heights are (r² − d²) / 20",
     draw_hills_one_and_many},
}};
constexpr std::array kNames = names_of(kFigures);
const std::array kSpecs{choice("figure", kNames, "figure of the paper")};

std::vector<Case> cases(const RunOptions&) { return cases_by("figure", kSpecs); }

void draw(const Case& at, const RunOptions& options, Recorder& recorder, Progress&) {
  draw_figure(kFigures, "ght", at, options, recorder);
}

}  // namespace

std::span<const figures::Figure> stage_figures() { return kFigures; }

extern const Experiment kStages{"ght.stages", "Figures 1 and 3-10: the generators, step by step", kSpecs,
                                cases, draw};

}  // namespace terrabench::ght
