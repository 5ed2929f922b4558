// Figures 3 to 13 of "hybrid": the noise graph, stage by stage, on one vertical slice; and of each stage what
// the paper says that it does to the one before.
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
#include "results/store/format.h"
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
    ParameterSpec{"pixels", std::int64_t{1024}, "pixels", "side of the square picture", 16, 8192},
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
  return find_components(*stack_at_resolution(source, side, progress));
}

// A stage's values in a square picture, row by row.
struct Pixels {
  int side;
  std::vector<float> values;
  float at(int i, int row) const {
    return values[static_cast<std::size_t>(row) * static_cast<std::size_t>(side) +
                  static_cast<std::size_t>(i)];
  }
};

// The largest difference of two values in one column: 0 if the fractal ignores y.
double column_spread(const Pixels& pixels) {
  float largest = 0;
  for (int i = 0; i < pixels.side; ++i) {
    float least = pixels.at(i, 0), most = least;
    for (int row = 1; row < pixels.side; ++row) {
      least = std::min(least, pixels.at(i, row));
      most = std::max(most, pixels.at(i, row));
    }
    largest = std::max(largest, most - least);
  }
  return largest;
}

double share_differing(const Pixels& a, const Pixels& b) {
  double differing = 0;
  for (std::size_t k = 0; k < a.values.size(); ++k) differing += a.values[k] != b.values[k];
  return differing / static_cast<double>(a.values.size());
}

// What the stage does to those before it.
void compare_stages(noise::Stage stage, const Pixels& now, const noise::CaveOptions& terrain,
                    Recorder& recorder, Progress& progress) {
  using noise::Stage;
  const auto other = [&](Stage at) {
    return Pixels{now.side, slice(noise::graph_for(at, terrain), terrain.extent, now.side, progress)};
  };
  if (stage == Stage::kFbm || stage == Stage::kFlatFbm) recorder.add("column_spread", "", column_spread(now));
  if (stage == Stage::kClampedRidged) {
    // The noise where the map has no cave lies below that where it has one.
    const Pixels noise = other(Stage::kRidged);
    float outside = 0, inside = 1;
    for (std::size_t k = 0; k < now.values.size(); ++k) {
      if (now.values[k] > 0.5F) {
        outside = std::max(outside, noise.values[k]);
      } else {
        inside = std::min(inside, noise.values[k]);
      }
    }
    recorder.add("highest_noise_outside", "", outside);
    recorder.add("lowest_noise_inside", "", inside);
  }
  if (stage == Stage::kPerturbedRidged)
    recorder.add("share_moved", "", share_differing(now, other(Stage::kClampedRidged)));
  if (stage == Stage::kMultiplied) {
    const Pixels ground = other(Stage::kXYPerturbed);
    Pixels product = other(Stage::kPerturbedRidged);
    for (std::size_t k = 0; k < product.values.size(); ++k) product.values[k] *= ground.values[k];
    recorder.add("share_off_product", "", share_differing(now, product));
  }
}

// Whether the stage shows noise, and not one of two values.
bool has_greys(noise::Stage stage) {
  using enum noise::Stage;
  return stage == kGradient || stage == kFbm || stage == kFlatFbm || stage == kRidged;
}

// The picture with its sides in metres, what its greys mean, and `words` below.
figures::Sheet sheet_of(const Image& image, const noise::StageInfo& stage, float extent,
                        std::string_view words) {
  constexpr double kLeft = 54, kTop = 32, kRight = 26, kBelow = 118;
  constexpr Rgb kGrey{96, 96, 96};
  constexpr int kTicks = 4, kText = 15;
  const double side = image.width / static_cast<double>(figures::Sheet::kPixels), bottom = kTop + side;
  figures::Sheet sheet(kLeft + side + kRight, bottom + kBelow);
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
  const bool caves =
      stage.stage == noise::Stage::kClampedRidged || stage.stage == noise::Stage::kPerturbedRidged;
  sheet.text(kLeft, bottom + 72,
             has_greys(stage.stage) ? fmt::format("black: {:g}; white: {:g}", stage.low, stage.high)
             : caves                ? "black: cave (0); white: none (1)"
                                    : "black: air (0); white: ground (1)",
             kText);
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
  std::string words;
  compare_stages(stage.stage, {side, values}, terrain, recorder, progress);
  const bool is_ground = stage.stage == Stage::kYPerturbed || stage.stage == Stage::kXYPerturbed ||
                         stage.stage == Stage::kMultiplied || stage.stage == Stage::kAttenuated;
  if (is_ground) {
    const Components found = pieces(values, terrain.extent, side, progress);
    recorder.add("overhang_columns", "", static_cast<double>(found.overhang_columns));
    recorder.add("floating_pieces", "", static_cast<double>(found.floating));
    const double depth = terrain.extent / side;  // m
    recorder.add("floating_area", "m²", found.floating_volume / depth);
    words = fmt::format("Ground that floats: {} pieces, {} m²", found.floating,
                        format_number(found.floating_volume / depth));
  }
  sheet_of(image, stage, terrain.extent, words)
      .write(recorder.figure(fmt::format("hybrid.F{}", stage.figure), "png",
                             fmt::format("Figure {} of the paper: {}. Vertical slice of {} m × {} m",
                                         stage.figure, stage.name, terrain.extent, terrain.extent)));
}

}  // namespace

extern const Experiment kNoiseStages{"hybrid.noise-stages", "Figures 3-13: the noise pipeline, step by step",
                                     kSpecs, cases, measure};

}  // namespace terrabench::hybrid
