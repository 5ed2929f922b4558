// Channel networks of the drill paper's §2.1 and §3.1: channel pixels per threshold, and the largest flow
// through one pixel, of the whole ground and of many crops, since a single one says as much about where it
// was cut as about the mountains.
#include "terrain/hydrology/channels.h"

#include <fmt/format.h>

#include <algorithm>

#include "experiments/drill/ground.h"
#include "experiments/experiment.h"
#include "results/store/statistics.h"
#include "terrain/hydrology/flow.h"
#include "terrain/hydrology/steepest.h"

namespace terrabench::drill {
namespace {

constexpr std::array kSpecs{
    ParameterSpec{"tau", std::int64_t{25}, "pixels", "least flow of a channel", 1, 1e9},
};

std::vector<Case> cases(const RunOptions& options) {
  std::vector<Case> cases;
  for (const std::string& ground : grounds(options)) {
    for (const std::int64_t tau : {25, 50, 100, 200, 400}) {
      cases.push_back({fmt::format("{}/tau={}", ground, tau), {kSpecs, {{"tau", tau}}}, ground});
    }
  }
  return cases;
}

double pixels_of(const Heightfield& ground) {  // with data
  return static_cast<double>(ground.heights.size() - height_range(ground).no_data);
}

void measure(const Case& test_case, const RunOptions& options, Recorder& recorder, Progress& progress) {
  const TerrainSource source = recorder.terrain(open_ground(test_case.terrain, options.seed));
  const FlowNetwork network = route_flow(*source.heights, &progress);
  const auto channels =
      channel_pixels(network, static_cast<std::uint32_t>(test_case.parameters.integer("tau")));
  const auto largest = static_cast<double>(std::ranges::max(network.accumulation));
  const double pixels = pixels_of(*source.heights);
  recorder.add("channel_pixels", "", channels.size());
  recorder.add("channel_share", "", static_cast<double>(channels.size()) / pixels);
  recorder.add("largest_flow", "", largest);
  recorder.add("largest_flow_share", "", largest / pixels);
}

const std::array kCropSpecs{
    ParameterSpec{"side", std::int64_t{200}, "samples", "side of a crop, at most that of the ground", 8,
                  16384},
    ParameterSpec{"columns", std::int64_t{6}, "", "crops from west to east, evenly spaced over the ground", 2,
                  1000},
    ParameterSpec{"rows", std::int64_t{4}, "", "crops from north to south", 2, 1000},
};

std::vector<Case> crop_cases(const RunOptions& options) {
  std::vector<Case> cases;
  for (const std::string& ground : grounds(options)) cases.push_back({ground, {kCropSpecs, {}}, ground});
  if (!options.terrains.empty()) return cases;
  // Large enough for separate crops of the paper's size.
  const std::int64_t along = 3, side = 400;
  cases.push_back({"maine", {kCropSpecs, {{"side", side}, {"columns", along}, {"rows", along}}}, "maine"});
  return cases;
}

void measure_crops(const Case& test_case, const RunOptions& options, Recorder& recorder, Progress& progress) {
  const TerrainSource source = recorder.terrain(open_ground(test_case.terrain, options.seed));
  const Heightfield& ground = *source.heights;
  const int side = std::min({test_case.integer("side"), ground.width, ground.depth});
  const int columns = test_case.integer("columns"), rows = test_case.integer("rows");
  progress.begin("routing crops", static_cast<std::uint64_t>(columns) * rows);
  std::vector<double> searched, steepest;  // shares of the pixels that drain through one
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      const Heightfield part = crop(ground, (ground.width - side) * column / (columns - 1),
                                    (ground.depth - side) * row / (rows - 1), side, side);
      progress.advance();
      if (pixels_of(part) == 0) continue;
      searched.push_back(std::ranges::max(route_flow(part).accumulation) / pixels_of(part));
      steepest.push_back(std::ranges::max(route_steepest(part).accumulation) / pixels_of(part));
    }
  }
  recorder.add("crops", "", searched.size());
  if (searched.empty()) return;
  recorder.add("least_share", "", std::ranges::min(searched));
  recorder.add("median_share", "", median(searched));
  recorder.add("largest_share", "", std::ranges::max(searched));
  recorder.add("steepest_median_share", "", median(steepest));
  recorder.add("steepest_largest_share", "", std::ranges::max(steepest));
}

}  // namespace

extern const Experiment kChannels{"drill.channels", "§3.1: channel pixels and the largest flow", kSpecs,
                                  cases, measure};
extern const Experiment kLargestFlow{"drill.largest-flow", "§3.1: the largest flow over crops of the ground",
                                     kCropSpecs, crop_cases, measure_crops};

}  // namespace terrabench::drill
