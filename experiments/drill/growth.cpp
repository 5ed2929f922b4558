// Time of each step against the size of the ground: windows of growing size on the same endless hills of
// noise, so that the work per pixel stays the same. Flow is routed over whole metres (integer keys) and over
// the same heights unrounded (heaps). Shapes are fitted as printed.
#include <fmt/format.h>

#include <string>
#include <utility>

#include "experiments/drill/factorial.h"
#include "experiments/drill/ground.h"
#include "experiments/experiment.h"
#include "experiments/ground.h"
#include "experiments/samples.h"
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

std::vector<Case> cases(const RunOptions& options) {
  std::vector<Case> cases;
  const std::int64_t largest = options.profile == Profile::kPaper ? 8192 : 1024;
  for (std::int64_t n = 256; n <= largest; n *= 2) {
    cases.push_back({fmt::format("n={}", n), {kSpecs, {{"n", n}}}});
  }
  return cases;
}

void measure(const Case& test_case, const RunOptions& options, Recorder& recorder, Progress& progress) {
  const int n = test_case.integer("n");
  const double pixels = static_cast<double>(n) * n;
  const Heightfield fine = noise_hills(n, options.seed), whole = whole_metres(fine);
  recorder.terrain("noise-hills", checksum(whole));

  FlowNetwork network;  // one at a time, to bound memory: it takes as much as the ground
  Drills drills;
  Samples samples;
  const auto time = [&](std::string metric, std::string_view rate, const auto& work) {
    samples.add(std::move(metric), "s", [&recorder, rate, work] {
      double done = 0;
      const double spent = seconds([&] { done = work(); });
      if (!rate.empty()) recorder.add(rate, "1/s", done / spent);
      return spent;
    });
  };
  const auto route = [&](const Heightfield& ground) {
    network = {};
    network = route_flow(ground);
    return pixels;
  };
  time("routing_time_unrounded", "routed_pixels_per_second_unrounded", [&] { return route(fine); });
  time("routing_time", "routed_pixels_per_second", [&] { return route(whole); });
  time("extraction_time", "drills_per_second", [&] {
    drills = extract_drills(whole, network, options_for({}));
    return static_cast<double>(drills.count());
  });
  time("regeneration_time", "", [&] { return regenerate(drills).heights[0]; });
  progress.begin(fmt::format("{0} × {0} samples", n), 1);
  samples.take(recorder);
  progress.advance();
  recorder.add("drills", "", drills.count());
}

}  // namespace

extern const Experiment kGrowth{
    "drill.growth", "§3.1: time against the size of the ground", kSpecs, cases, measure, Experiment::kTimed};

}  // namespace terrabench::drill
