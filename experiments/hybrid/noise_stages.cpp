// Figures 3 to 13 of "hybrid": the noise graph, stage by stage, on one vertical slice.
#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "experiments/experiment.h"
#include "experiments/figures/sheet.h"
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

void measure(const Case& at, const RunOptions& options, Recorder& recorder, Progress& progress) {
  const noise::StageInfo& stage =
      noise::info(static_cast<noise::Stage>(at.parameters.integer("figure") - kFirstFigure));
  const int side = at.integer("pixels");
  const noise::CaveOptions terrain{.seed = options.seed};
  const noise::CaveGraph graph = noise::graph_for(stage.stage, terrain);
  recorder.terrain(fmt::format("caves ({})", stage.name), checksum(graph.graph.describe()));
  const noise::Program program(graph.graph, graph.root);

  // Rows run upwards in the slice and downwards in the picture; samples are at pixel centres.
  const float step = terrain.extent / static_cast<float>(side);
  std::vector<float> values(static_cast<std::size_t>(side) * side);
  progress.begin(stage.name, side);
  tbb::parallel_for(0, side, [&](int row) {
    program.slice(
        {step / 2, (static_cast<float>(row) + 0.5F) * step, step, step, terrain.extent / 2, side, 1},
        std::span(values).subspan(static_cast<std::size_t>(row) * side, side));
    progress.advance();
  });

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
