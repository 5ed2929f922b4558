// Channel networks of the drill paper's §2.1 and §3.1: channel pixels per threshold, and the largest flow of
// the whole ground (largest_flow.cpp takes it over crops).
#include "terrain/hydrology/channels.h"

#include <fmt/format.h>

#include <algorithm>

#include "experiments/drill/ground.h"
#include "experiments/experiment.h"
#include "terrain/hydrology/flow.h"

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

void measure(const Case& at, const RunOptions& options, Recorder& recorder, Progress& progress) {
  const TerrainSource source = recorder.terrain(open_ground(at.terrain, options.seed));
  const FlowNetwork network = route_flow(*source.heights, &progress);
  const auto channels = channel_pixels(network, static_cast<std::uint32_t>(at.parameters.integer("tau")));
  const auto largest =
      static_cast<double>(*std::max_element(network.accumulation.begin(), network.accumulation.end()));
  const auto pixels = static_cast<double>(source.heights->heights.size()) -
                      static_cast<double>(height_range(*source.heights).no_data);
  recorder.add("channel_pixels", "", channels.size());
  recorder.add("channel_share", "", static_cast<double>(channels.size()) / pixels);
  recorder.add("largest_flow", "", largest);
  recorder.add("largest_flow_share", "", largest / pixels);
}

}  // namespace

extern const Experiment kChannels{"drill.channels", "§3.1: channel pixels and the largest flow", kSpecs,
                                  cases, measure};

}  // namespace terrabench::drill
