// Time of each step against the size of the ground: windows of growing size on the same endless hills of
// noise, so that the work per pixel stays the same. Flow is routed over whole metres (integer keys) and over
// the same heights unrounded (heaps). Shapes are fitted as printed.
#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "experiments/drill/factorial.h"
#include "experiments/drill/ground.h"
#include "experiments/experiment.h"
#include "experiments/ground.h"
#include "experiments/stopwatch.h"
#include "representations/drill/extract.h"
#include "representations/drill/regenerate.h"
#include "terrain/files.h"
#include "terrain/hydrology/flow.h"

namespace terrabench::drill {
namespace {

const std::array kSpecs{
    ParameterSpec{"n", std::int64_t{1024}, "samples", "side of the ground", 64, 16384},
};

// Small grounds are measured more often; the largest take seconds, and one sample is enough.
constexpr double kSampledPixels = 1 << 25;
constexpr int kMostSamples = 9;

std::vector<Case> cases(const RunOptions& options) {
  std::vector<Case> cases;
  const std::int64_t largest = options.profile == Profile::kPaper ? 8192 : 1024;
  for (std::int64_t n = 256; n <= largest; n *= 2) {
    cases.push_back({fmt::format("n={}", n), {kSpecs, {{"n", n}}}});
  }
  return cases;
}

void measure(const Case& at, const RunOptions& options, Recorder& recorder, Progress& progress) {
  const int n = at.integer("n");
  const double pixels = static_cast<double>(n) * n;
  const Heightfield fine = noise_hills(n, options.seed), whole = whole_metres(fine);
  recorder.terrain("noise-hills", checksum(whole));
  recorder.add("pixels", "", pixels);

  const int samples = std::clamp(static_cast<int>(kSampledPixels / pixels), 1, kMostSamples);
  const int warming = samples > 1 ? 1 : 0;  // rounds that are not recorded
  progress.begin(fmt::format("{0} × {0} samples", n), samples + warming);
  std::size_t drilled = 0;
  for (int sample = -warming; sample < samples; ++sample) {
    std::optional<FlowNetwork> network;
    const double routing_fine = seconds([&] { network = route_flow(fine); });
    network.reset();  // one at a time, to bound memory: a network takes as much as the ground
    const double routing = seconds([&] { network = route_flow(whole); });
    Drills drills;
    const double extraction = seconds([&] { drills = extract_drills(whole, *network, options_for({})); });
    network.reset();
    const double regeneration = seconds([&] { regenerate(drills); });
    drilled = drills.count();
    progress.advance();
    if (sample < 0) continue;
    recorder.add("routing_time", "s", routing);
    recorder.add("routing_time_unrounded", "s", routing_fine);
    recorder.add("extraction_time", "s", extraction);
    recorder.add("regeneration_time", "s", regeneration);
    recorder.add("routed_pixels_per_second", "1/s", pixels / routing);
    recorder.add("routed_pixels_per_second_unrounded", "1/s", pixels / routing_fine);
    recorder.add("drills_per_second", "1/s", static_cast<double>(drills.count()) / extraction);
  }
  recorder.add("drills", "", drilled);
}

}  // namespace

extern const Experiment kGrowth{
    "drill.growth", "§3.1: time against the size of the ground", kSpecs, cases, measure, Experiment::kTimed};

}  // namespace terrabench::drill
