// Channel networks of the drill paper's §2.1 and §3.1: how many pixels a threshold gives, and the largest
// flow.
#include "terrain/hydrology/channels.h"

#include <fmt/format.h>

#include <algorithm>

#include "experiments/drill/drill.h"
#include "experiments/drill/ground.h"
#include "terrain/hydrology/flow.h"

namespace terrabench::drill {
namespace {

constexpr std::array kSpecs{
    ParameterSpec{"tau", std::int64_t{25}, "pixels", "least flow of a channel", 1, 1e9},
};

}  // namespace

constinit const std::span<const ParameterSpec> kChannelParameters = kSpecs;

std::vector<Case> channel_cases(const RunOptions& options) {
  std::vector<Case> cases;
  for (const std::string& ground : grounds(options)) {
    for (const std::int64_t tau : {25, 50, 100, 200, 400}) {
      Case& added = cases.emplace_back(
          Case{fmt::format("{}/tau={}", ground, tau), Parameters(kChannelParameters), ground});
      added.parameters.set("tau", tau);
    }
  }
  return cases;
}

void measure_channels(const Case& at, const RunOptions& options, Recorder& recorder, Progress& progress) {
  const TerrainSource source = open_ground(at.terrain, options.seed);
  recorder.terrain(source);
  const FlowNetwork network = route_flow(*source.heights, &progress);
  const auto channels = channel_pixels(network, static_cast<std::uint32_t>(at.parameters.integer("tau")));
  const auto largest =
      static_cast<double>(*std::max_element(network.accumulation.begin(), network.accumulation.end()));
  const auto pixels = static_cast<double>(source.heights->heights.size()) -
                      static_cast<double>(height_range(*source.heights).no_data);
  recorder.add("channel_pixels", "", static_cast<double>(channels.size()));
  recorder.add("channel_share", "", static_cast<double>(channels.size()) / pixels);
  recorder.add("largest_flow", "", largest);
  recorder.add("largest_flow_share", "", largest / pixels);
}

}  // namespace terrabench::drill
