// Figures 13, 17, 18 and 22 of "ght": what events make of the ground, as ground planes, wireframe and solid.
#include <fmt/format.h>

#include <array>
#include <cmath>

#include "experiments/experiment.h"
#include "experiments/ght/events.h"
#include "terrain/error.h"
#include "terrain/events/event.h"
#include "terrain/events/scripts.h"

namespace terrabench::ght {
namespace {

using namespace events;

constexpr std::array kSpecs{
    ParameterSpec{"figure", std::int64_t{13}, "", "number of the figure in the paper", 13, 24},
};
constexpr std::array<std::int64_t, 10> kFigures{13, 15, 17, 18, 19, 20, 21, 22, 23, 24};

std::vector<Panel> three_views(GlContext& context, const Ght& ght, const Look& look, std::string_view name) {
  std::vector<Panel> row;
  row.push_back({planes_view(context, ght, look), fmt::format("{}: ground planes", name)});
  row.push_back({wires_view(context, ght, look), "wireframe"});
  row.push_back({solid_view(context, ght, look), "solid"});
  return row;
}

// Level ground with furrows from north to south, 41 samples of 10 m a side.
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

constexpr glm::vec3 kHigh{0.4F, 0.62F, 1.0F}, kLow{0.45F, 0.4F, 1.0F};  // the latter under an overhang

// Across the middle of a fault's line.
CutPlane across(std::string_view script) {
  const TerrainSource source = open_named_script(script);
  const Line line = std::get<DipFault>(source.events->events.at(0)).line();
  return {glm::vec2(line.plan({line.length / 2, 0})), glm::vec2(line.along)};
}

}  // namespace

Ght open_tree(std::string_view script, bool with_events) {
  const TerrainSource source = open_named_script(script);
  const Heightfield& field = source.events->ground;
  // As low as the events need it: the solid's own floor allows for the worst that they could do.
  Ght ght({field.width, field.depth, field.cell_x, field.cell_z, 0, 0}, field.heights,
          height_range(field).lowest - 3 * field.cell_x);
  if (with_events) {
    for (const Event& event : source.events->events) ght.apply(event);
  }
  return ght;
}

void write_panels(const std::vector<std::vector<Panel>>& rows, const std::filesystem::path& png) {
  constexpr double kMargin = 14, kLabel = 26;
  double width = 0, height = kMargin;
  for (const std::vector<Panel>& row : rows) {
    double across = kMargin;
    for (const Panel& panel : row) across += panel.image.width / figures::Sheet::kPixels + kMargin;
    width = std::max(width, across);
    height += row[0].image.height / figures::Sheet::kPixels + kLabel + kMargin;
  }
  figures::Sheet sheet(width, height);
  double y = kMargin;
  for (const std::vector<Panel>& row : rows) {
    double across = kMargin;
    for (const Panel& panel : row) across += panel.image.width / figures::Sheet::kPixels + kMargin;
    double x = kMargin + (width - across) / 2;
    for (const Panel& panel : row) {
      const double wide = static_cast<double>(panel.image.width) / figures::Sheet::kPixels;
      const double high = static_cast<double>(panel.image.height) / figures::Sheet::kPixels;
      sheet.picture(x, y, wide, high, panel.image);
      sheet.text(x + wide / 2, y + high + 17, panel.words, 14, "middle");
      x += wide + kMargin;
    }
    y += row[0].image.height / figures::Sheet::kPixels + kLabel + kMargin;
  }
  sheet.write(png);
}

void draw_geotectonic_events(GlContext& context, Recorder& recorder) {
  const glm::dvec2 from{110, 230}, to{290, 170};
  const std::array<std::pair<const char*, Event>, 5> events{{
      {"linear erosion", LinearErosion{from, to, 45, 38}},
      {"radial erosion", RadialErosion{{200, 10, 200}, {110, 70, 80}}},
      {"normal fault", DipFault{false, from, to, 110, 70, 60}},
      {"inverse fault", DipFault{true, from, to, 110, 70, 50}},
      {"lateral fault", LateralFault{from, to, 90, 90}},
  }};
  std::vector<std::vector<Panel>> rows;
  for (const auto& [name, event] : events) {
    Ght ght = small_ground();
    ght.apply(event);
    rows.push_back(
        three_views(context, ght, {kind(event) == Kind::kInverseFault ? kLow : kHigh, 640, 380, {}}, name));
  }
  write_panels(rows,
               recorder.figure("ght.F13", "png",
                               "Figure 13 of the paper: the shapes that geotectonic events make of level "
                               "ground, as ground planes (the root's grey), wireframe and solid"));
}

void draw_erosions(GlContext& context, Recorder& recorder) {
  std::vector<std::vector<Panel>> rows;
  const Look look{{-0.7F, 0.9F, 0.9F}, 760, 480, {}};
  rows.push_back(three_views(context, open_tree("linear-erosion"), look, "linear erosion"));
  rows.push_back(three_views(context, open_tree("radial-erosion"), look, "radial erosion"));
  write_panels(rows,
               recorder.figure("ght.F17", "png",
                               "Figure 17 of the paper: linear and radial erosions, each on the same fresh "
                               "terrain of 129 × 129; what an event made has a colour in the wireframe"));
}

void draw_faults(GlContext& context, Recorder& recorder) {
  std::vector<std::vector<Panel>> rows;
  std::vector<Panel> cuts;
  for (const char* const name : {"normal", "inverse"}) {
    const std::string script = fmt::format("{}-fault", name);
    const Ght ght = open_tree(script);
    rows.push_back(three_views(context, ght, {kLow, 760, 430, {}}, fmt::format("{} fault", name)));
    cuts.push_back({solid_view(context, ght, {{1.0F, 0.25F, 0.6F}, 1154, 480, {across(script)}}),
                    fmt::format("{} fault, cut across its line", name)});
  }
  rows.push_back(std::move(cuts));
  write_panels(rows,
               recorder.figure("ght.F18", "png",
                               "Figure 18 of the paper: a normal and an inverse fault, each on the same "
                               "fresh terrain; the raised block of the inverse one hangs over"));
}

void draw_sequence(GlContext& context, Recorder& recorder) {
  const Look look{{0.4F, 0.7F, 1.0F}, 1060, 630, {}};
  const Ght fresh = open_tree("canyon", false), ght = open_tree("canyon");
  const std::size_t events = ght.model().tree.events().size(), nodes = ght.model().tree.nodes().size();
  write_panels({{{wires_view(context, fresh, look), "fresh terrain, wireframe"},
                 {solid_view(context, fresh, look), "fresh terrain, solid"}},
                {{wires_view(context, ght, look), fmt::format("after {} events, wireframe", events)},
                 {solid_view(context, ght, look), fmt::format("after {} events, solid", events)}},
                {{planes_view(context, ght, look), fmt::format("the {} ground planes", nodes)}}},
               recorder.figure("ght.F22", "png",
                               "Figure 22 of the paper: a sequence of overlapping events on one terrain, and "
                               "the ground planes of the tree after it"));
}

namespace {

std::vector<Case> cases(const RunOptions&) {
  std::vector<Case> cases;
  for (const std::int64_t figure : kFigures) {
    cases.push_back({fmt::format("F{}", figure), {kSpecs, {{"figure", figure}}}, ""});
  }
  return cases;
}

void draw(const Case& at, const RunOptions& options, Recorder& recorder, Progress&) {
  const std::int64_t figure = at.parameters.integer("figure");
  if (std::find(kFigures.begin(), kFigures.end(), figure) == kFigures.end()) {
    throw usage_error(fmt::format("figure {} is a listing of code", figure), "figure",
                      "figures 13, 15 and 17 to 24 are there");
  }
  const auto context = [&] { return open_context(options.renderer, 64, 64); };
  recorder.add("figure", "", static_cast<double>(figure));
  switch (figure) {
    case 13:
      return draw_geotectonic_events(*context(), recorder);
    case 15:
      return draw_carving_shapes(*context(), recorder);
    case 17:
      return draw_erosions(*context(), recorder);
    case 18:
      return draw_faults(*context(), recorder);
    case 19:
      return draw_tunnel(*context(), recorder);
    case 20:
      return draw_cave(*context(), recorder);
    case 21:
      return draw_two_tunnels(*context(), recorder);
    case 22:
      return draw_sequence(*context(), recorder);
    case 23:
      return draw_tree(recorder);
    default:
      return draw_rain(*context(), options.seed, recorder);
  }
}

}  // namespace

extern const Experiment kEventFigures{"ght.event-figures", "Figures 13, 15 and 17-24: events and their trees",
                                      kSpecs, cases, draw};

}  // namespace terrabench::ght
