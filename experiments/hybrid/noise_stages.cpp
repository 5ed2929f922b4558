// Figures 3 to 13 of "hybrid": the noise graph, stage by stage, on one vertical slice. Figure 12 is compared
// with the product of the figures that it is made of, and the ground that floats is measured in the figures
// around it.
#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "experiments/build_at.h"
#include "experiments/experiment.h"
#include "experiments/figures/sheet.h"
#include "representations/layered_stack/components.h"
#include "terrain/files.h"
#include "terrain/image.h"
#include "terrain/sources/noise/cave_terrain.h"
#include "terrain/sources/noise/program.h"

namespace terrabench::hybrid {
namespace {

constexpr std::int64_t kFirstFigure = 3,
                       kLastFigure = kFirstFigure + noise::kStages - 1;  // a figure per stage

constexpr std::array kSpecs{
    ParameterSpec{"figure", kFirstFigure, "", "number of the figure in the paper", kFirstFigure, kLastFigure},
    ParameterSpec{"pixels", std::int64_t{512}, "pixels", "side of the square picture", 16, 8192},
};

std::vector<Case> cases(const RunOptions&) {
  std::vector<Case> cases;
  for (std::int64_t figure = kFirstFigure; figure <= kLastFigure; ++figure) {
    cases.push_back({fmt::format("F{}", figure), {kSpecs, {{"figure", figure}}}});
  }
  return cases;
}

// Rows run upwards in the slice and downwards in the picture; samples are at pixel centres.
std::vector<float> slice(const noise::CaveGraph& graph, float extent, int side, Progress& progress) {
  const noise::Program program(graph.graph, graph.root);
  const float step = extent / static_cast<float>(side);
  std::vector<float> values(static_cast<std::size_t>(side) * side);
  progress.begin("slice", side);
  tbb::parallel_for(0, side, [&](int row) {
    program.slice({step / 2, (static_cast<float>(row) + 0.5F) * step, step, step, extent / 2, side, 1},
                  std::span(values).subspan(static_cast<std::size_t>(row) * side, side));
    progress.advance();
  });
  return values;
}

// The connected pieces of ground in the picture, as hybrid.caves finds them in space: a pixel is a cell of a
// terrain that is one cell deep.
Components pieces(const std::vector<float>& values, float extent, int side, Progress& progress) {
  const float step = extent / static_cast<float>(side);
  Solid solid;
  solid.bounds = {glm::vec3(0), glm::vec3(extent, extent, step)};
  solid.column = [&](const ColumnSamples& at, std::span<Material> out) {
    const auto column = static_cast<std::size_t>(at.x / step);
    for (std::size_t row = 0; row < out.size(); ++row)
      out[row] = values[row * side + column] > 0.5F ? Material::kBedrock : Material::kAir;
  };
  TerrainSource source;
  source.solid = std::move(solid);
  const auto built = build_at_resolution("layered_stack", source, side, progress);
  return find_components(dynamic_cast<const LayeredStack&>(*built));
}

// Pixels of figure 12 that are not the product of figures 8 and 11.
double pixels_off_product(const std::vector<float>& values, const noise::CaveOptions& terrain, int side,
                          Progress& progress) {
  const std::vector<float> ground =
      slice(noise::graph_for(noise::Stage::kXYPerturbed, terrain), terrain.extent, side, progress);
  const std::vector<float> caves =
      slice(noise::graph_for(noise::Stage::kPerturbedRidged, terrain), terrain.extent, side, progress);
  double off = 0;
  for (std::size_t i = 0; i < values.size(); ++i) off += values[i] != ground[i] * caves[i];
  return off;
}

void measure(const Case& at, const RunOptions& options, Recorder& recorder, Progress& progress) {
  using noise::Stage;
  const noise::StageInfo& stage =
      noise::info(static_cast<Stage>(at.parameters.integer("figure") - kFirstFigure));
  const int side = at.integer("pixels");
  const noise::CaveOptions terrain{.seed = options.seed};
  const noise::CaveGraph graph = noise::graph_for(stage.stage, terrain);
  recorder.terrain(fmt::format("caves ({})", stage.name), checksum(graph.graph.describe()));
  const std::vector<float> values = slice(graph, terrain.extent, side, progress);

  Image image(side, side, {});
  double sum = 0, shown = 0;
  for (int row = 0; row < side; ++row) {
    for (int i = 0; i < side; ++i) {
      const float value = values[static_cast<std::size_t>(row) * side + i];
      sum += value;
      const float grey = std::clamp((value - stage.low) / (stage.high - stage.low), 0.0F, 1.0F);
      shown += grey;
      const auto byte = static_cast<std::uint8_t>(std::lround(grey * 255));
      image.set(i, side - 1 - row, {byte, byte, byte});
    }
  }
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  recorder.add("mean", "", sum / static_cast<double>(values.size()));
  recorder.add("mean_shown", "", shown / static_cast<double>(values.size()));  // of 0 black to 1 white
  recorder.add("least", "", *least);
  recorder.add("most", "", *most);
  if (stage.stage == Stage::kMultiplied)
    recorder.add("pixels_off_product", "", pixels_off_product(values, terrain, side, progress));
  if (stage.stage == Stage::kXYPerturbed || stage.stage == Stage::kMultiplied ||
      stage.stage == Stage::kAttenuated) {
    const Components found = pieces(values, terrain.extent, side, progress);
    recorder.add("floating_pieces", "", static_cast<double>(found.floating));
    const double depth = terrain.extent / side;  // m
    recorder.add("floating_area", "m²", found.floating_volume / depth);
  }
  figures::write_picture(
      recorder.figure(
          fmt::format("hybrid.F{}", stage.figure), "png",
          fmt::format("Figure {} of the paper: {}. Vertical slice of {} m × {} m, black {}, white {}",
                      stage.figure, stage.name, terrain.extent, terrain.extent, stage.low, stage.high)),
      image);
}

}  // namespace

extern const Experiment kNoiseStages{"hybrid.noise-stages", "Figures 3-13: the noise pipeline, step by step",
                                     kSpecs, cases, measure};

}  // namespace terrabench::hybrid
