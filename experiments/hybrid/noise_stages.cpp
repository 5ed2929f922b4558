// Figures 3 to 13 of "hybrid": the noise graph, stage by stage, on one vertical slice; and of each stage what
// the paper says that it does to the one before.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "experiments/build_at.h"
#include "experiments/experiment.h"
#include "experiments/figures/maps.h"
#include "experiments/figures/sheet.h"
#include "experiments/hybrid/stage_relations.h"
#include "representations/layered_stack/components.h"
#include "results/store/format.h"
#include "terrain/files.h"
#include "terrain/image.h"
#include "terrain/sources/noise/cave_terrain.h"

namespace terrabench::hybrid {
namespace {

constexpr std::int64_t kFirstFigure = 3,
                       kLastFigure = kFirstFigure + noise::kStages - 1;  // a figure per stage

constexpr std::array kSpecs{
    ParameterSpec{"figure", kFirstFigure, "", "number of the figure in the paper", kFirstFigure, kLastFigure},
    ParameterSpec{"pixels", std::int64_t{1024}, "pixels", "side of the square picture", 16, 8192},
};

std::vector<Case> cases(const RunOptions&) {
  std::vector<Case> cases;
  for (std::int64_t figure = kFirstFigure; figure <= kLastFigure; ++figure) {
    cases.push_back({fmt::format("F{}", figure), {kSpecs, {{"figure", figure}}}});
  }
  return cases;
}

// The connected pieces of ground in the picture, as hybrid.caves finds them in space: a pixel is a cell of a
// terrain that is one cell deep. A piece that touches a side of the picture may be connected to the ground
// outside it, so a vertical wall of ground at each side connects such pieces.
Components pieces(const Pixels& pixels, float extent, Progress& progress) {
  const int side = pixels.side;
  const float step = extent / static_cast<float>(side);
  Solid solid;
  solid.bounds = {glm::vec3(0), glm::vec3(extent + 2 * step, extent, step)};
  solid.column = [&](const ColumnSamples& at, std::span<Material> out) {
    const int i = static_cast<int>(at.x / step) - 1;
    const bool wall = i < 0 || i >= side;
    for (std::size_t k = 0; k < out.size(); ++k) {
      const int row = static_cast<int>((at.y0 + static_cast<float>(k) * at.dy) / step);
      out[k] = wall || pixels.at(i, row) > 0.5F ? Material::kBedrock : Material::kAir;
    }
  };
  TerrainSource source;
  source.solid = std::move(solid);
  return find_components(*stack_at_resolution(source, side + 2, progress));
}

// Whether the stage shows noise, and not one of two values.
bool has_greys(noise::Stage stage) {
  using enum noise::Stage;
  return stage == kGradient || stage == kFbm || stage == kFlatFbm || stage == kRidged;
}

Rgb grey_of(double share) {
  const auto byte = static_cast<std::uint8_t>(std::lround(255 * share));
  return {byte, byte, byte};
}

std::string number(float value) {
  return value < 0 ? fmt::format("−{:g}", -value) : fmt::format("{:g}", value);
}

// The picture with its sides in metres, what its greys mean, and `words` below.
figures::Sheet sheet_of(const Image& image, const noise::StageInfo& stage, float extent,
                        std::string_view words) {
  constexpr double kLeft = 54, kTop = 32, kRight = 26;
  const double below = words.empty() ? 96 : 112;
  constexpr Rgb kGrey{96, 96, 96};
  constexpr int kTicks = 4, kText = 15;
  const double side = image.width / static_cast<double>(figures::Sheet::kPixels), bottom = kTop + side;
  figures::Sheet sheet(kLeft + side + kRight, bottom + below);
  sheet.box(kLeft - 1, kTop - 1, side + 2, side + 2, kGrey);
  sheet.picture(kLeft, kTop, side, side, image);
  sheet.text(8, kTop - 12, "y, m", kText);
  sheet.text(kLeft + side / 2, bottom + 42, "x, m", kText, "middle");
  for (int k = 0; k <= kTicks; ++k) {
    const double along = side * k / kTicks;
    const std::string metres = fmt::format("{:g}", extent * static_cast<float>(k) / kTicks);
    sheet.stroke({kLeft + along, bottom}, {kLeft + along, bottom + 6}, kGrey, 1);
    sheet.text(kLeft + along, bottom + 22, metres, kText, "middle");
    sheet.stroke({kLeft - 6, bottom - along}, {kLeft, bottom - along}, kGrey, 1);
    sheet.text(kLeft - 10, bottom - along + 5, metres, kText, "end");
  }
  if (has_greys(stage.stage)) {
    figures::add_colour_key(sheet, kLeft, bottom + 58, "value", 44, 240, grey_of,
                            {number(stage.low), number(stage.high)});
  } else {
    const bool caves =
        stage.stage == noise::Stage::kClampedRidged || stage.stage == noise::Stage::kPerturbedRidged;
    const auto swatch = [&](double x, Rgb colour, std::string_view meaning) {
      sheet.box(x - 1, bottom + 58, 24, 18, kGrey);
      sheet.box(x, bottom + 59, 22, 16, colour);
      sheet.text(x + 30, bottom + 72, meaning, kText);
    };
    swatch(kLeft + 1, {0, 0, 0}, caves ? "0: cave" : "0: air");
    swatch(kLeft + 141, {255, 255, 255}, caves ? "1: no cave" : "1: ground");
  }
  sheet.text(kLeft, bottom + 96, words, kText);
  return sheet;
}

void measure(const Case& at, const RunOptions& options, Recorder& recorder, Progress& progress) {
  using noise::Stage;
  const noise::StageInfo& stage =
      noise::info(static_cast<Stage>(at.parameters.integer("figure") - kFirstFigure));
  const int side = at.integer("pixels");
  const noise::CaveOptions terrain{.seed = options.seed};
  const noise::CaveGraph graph = noise::graph_for(stage.stage, terrain);
  recorder.terrain(fmt::format("caves ({})", stage.name), checksum(graph.graph.describe()));
  const Pixels pixels = slice_of(stage.stage, terrain, side, progress);

  Image image(side, side, {});
  double sum = 0, shown = 0;
  for (int row = 0; row < side; ++row) {
    for (int i = 0; i < side; ++i) {
      const float value = pixels.at(i, row);
      sum += value;
      const float grey = std::clamp((value - stage.low) / (stage.high - stage.low), 0.0F, 1.0F);
      shown += grey;
      image.set(i, side - 1 - row, grey_of(grey));
    }
  }
  const auto [least, most] = std::minmax_element(pixels.values.begin(), pixels.values.end());
  recorder.add("mean", "", sum / static_cast<double>(pixels.values.size()));
  recorder.add("mean_shown", "", shown / static_cast<double>(pixels.values.size()));  // of 0 black to 1 white
  recorder.add("least", "", *least);
  recorder.add("most", "", *most);
  std::string words;
  compare_stages(stage.stage, pixels, terrain, recorder, progress);
  const bool is_ground = stage.stage == Stage::kYPerturbed || stage.stage == Stage::kXYPerturbed ||
                         stage.stage == Stage::kMultiplied || stage.stage == Stage::kAttenuated;
  if (is_ground) {
    const Components found = pieces(pixels, terrain.extent, progress);
    recorder.add("overhang_columns", "", static_cast<double>(found.overhang_columns));
    recorder.add("floating_pieces", "", static_cast<double>(found.floating));
    const double depth = terrain.extent / side;  // m
    recorder.add("floating_area", "m²", found.floating_volume / depth);
    words = fmt::format("Ground that floats: {} pieces, {} m²", found.floating,
                        format_number(found.floating_volume / depth));
  }
  sheet_of(image, stage, terrain.extent, words)
      .write(recorder.figure(fmt::format("hybrid.F{}", stage.figure),
                             fmt::format("Figure {} of the paper: {}. Vertical slice of {} m × {} m",
                                         stage.figure, stage.name, terrain.extent, terrain.extent)));
}

}  // namespace

extern const Experiment kNoiseStages{"hybrid.noise-stages", "Figures 3-13: the noise pipeline, step by step",
                                     kSpecs, cases, measure};

}  // namespace terrabench::hybrid
