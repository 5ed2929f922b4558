// What each step costs on ever larger grounds: one window, growing, of the same endless hills of noise, so
// that a pixel has as much to do everywhere. Flow is routed over whole metres (integer keys) and over the
// same heights unrounded (heaps).
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <optional>

#include "experiments/drill/drill.h"
#include "experiments/drill/ground.h"
#include "representations/drill/extract.h"
#include "representations/drill/regenerate.h"
#include "terrain/files.h"
#include "terrain/hydrology/flow.h"

namespace terrabench::drill {
namespace {

const std::array kSpecs{
    ParameterSpec{"n", std::int64_t{1024}, "samples", "side of the ground", 64, 16384},
};

// Small grounds are measured more often; the largest in seconds, where one sample says as much.
constexpr double kSampledPixels = 1 << 25;
constexpr int kMostSamples = 9;

template <class Work>
double seconds(const Work& work) {
  const auto begin = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

}  // namespace

constinit const std::span<const ParameterSpec> kGrowthParameters = kSpecs;

std::vector<Case> growth_cases(const RunOptions& options) {
  std::vector<Case> cases;
  const std::int64_t largest = options.profile == Profile::kPaper ? 8192 : 1024;
  for (std::int64_t n = 256; n <= largest; n *= 2) {
    Case& added = cases.emplace_back(Case{fmt::format("n={}", n), Parameters(kGrowthParameters), ""});
    added.parameters.set("n", n);
  }
  return cases;
}

void measure_growth(const Case& at, const RunOptions& options, Recorder& recorder, Progress& progress) {
  const auto n = static_cast<int>(at.parameters.integer("n"));
  const double pixels = static_cast<double>(n) * n;
  const Heightfield fine = noise_hills(n, options.seed), whole = whole_metres(fine);
  recorder.terrain("noise-hills", checksum(whole));
  recorder.add("pixels", "", pixels);

  const int samples = std::clamp(static_cast<int>(kSampledPixels / pixels), 1, kMostSamples);
  // The first round of several warms up.
  const int warming = samples > 1 ? 1 : 0;
  progress.begin(fmt::format("{0} × {0} samples", n), samples + warming);
  std::size_t drilled = 0;
  for (int sample = -warming; sample < samples; ++sample) {
    std::optional<FlowNetwork> network;
    const double routing_fine = seconds([&] { network = route_flow(fine); });
    network.reset();  // only one at a time: the largest takes as much memory as the ground
    const double routing = seconds([&] { network = route_flow(whole); });
    DrillOptions extract;
    extract.tau = 25;
    extract.w = 10;
    extract.k = 20;
    Drills drills;
    const double extraction = seconds([&] { drills = extract_drills(whole, *network, extract); });
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
  recorder.add("drills", "", static_cast<double>(drilled));
}

}  // namespace terrabench::drill
