// The largest flow through one pixel (the drill paper's §3.1) over many crops of a ground, since a single one
// says as much about where it was cut as about the mountains.
#include <algorithm>
#include <vector>

#include "experiments/drill/ground.h"
#include "experiments/experiment.h"
#include "results/store/statistics.h"
#include "terrain/hydrology/flow.h"
#include "terrain/hydrology/steepest.h"

namespace terrabench::drill {
namespace {

const std::array kSpecs{
    ParameterSpec{"side", std::int64_t{200}, "samples", "side of a crop, at most that of the ground", 8,
                  16384},
};
constexpr int kColumns = 6, kRows = 4;  // crops, evenly spaced over the ground; neighbours overlap

std::vector<Case> cases(const RunOptions& options) {
  std::vector<Case> cases;
  for (const std::string& ground : grounds(options)) cases.push_back({ground, {kSpecs, {}}, ground});
  return cases;
}

double largest_share(const FlowNetwork& network, const Heightfield& ground) {
  const auto pixels = static_cast<double>(ground.heights.size() - height_range(ground).no_data);
  return static_cast<double>(std::ranges::max(network.accumulation)) / pixels;
}

void record(const std::vector<double>& shares, const std::string& prefix, Recorder& recorder) {
  recorder.add(prefix + "least_share", "", std::ranges::min(shares));
  recorder.add(prefix + "median_share", "", summarise(shares).median);
  recorder.add(prefix + "largest_share", "", std::ranges::max(shares));
}

void measure(const Case& at, const RunOptions& options, Recorder& recorder, Progress& progress) {
  const TerrainSource source = recorder.terrain(open_ground(at.terrain, options.seed));
  const Heightfield& ground = *source.heights;
  const int side = std::min({at.integer("side"), ground.width, ground.depth});
  progress.begin("routing crops", kColumns * kRows);
  std::vector<double> searched, steepest;
  for (int row = 0; row < kRows; ++row) {
    for (int column = 0; column < kColumns; ++column) {
      const Heightfield part = crop(ground, (ground.width - side) * column / (kColumns - 1),
                                    (ground.depth - side) * row / (kRows - 1), side, side);
      progress.advance();
      if (height_range(part).no_data == part.heights.size()) continue;
      searched.push_back(largest_share(route_flow(part), part));
      steepest.push_back(largest_share(route_steepest(part), part));
    }
  }
  recorder.add("crops", "", searched.size());
  if (searched.empty()) return;
  record(searched, "", recorder);
  record(steepest, "steepest_", recorder);
}

}  // namespace

extern const Experiment kLargestFlow{"drill.largest-flow", "§3.1: the largest flow over crops of the ground",
                                     kSpecs, cases, measure};

}  // namespace terrabench::drill
