// What extraction and regeneration cost, against the number of drills (the drill paper's §3.1).
#include <fmt/format.h>

#include <array>
#include <chrono>
#include <vector>

#include "experiments/drill/drill.h"
#include "experiments/drill/ground.h"
#include "representations/drill/extract.h"
#include "representations/drill/regenerate.h"
#include "results/statistics.h"
#include "terrain/hydrology/flow.h"

namespace terrabench::drill {
namespace {

constexpr int kSamples = 9;
constexpr std::array<std::uint32_t, 8> kTimedTaus{10, 15, 25, 50, 100, 200, 400, 800};

template <class Work>
double seconds(const Work& work) {
  const auto begin = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

// Least squares of y = intercept + slope · x.
struct Line {
  double slope = 0, intercept = 0, r_squared = 0;
};

Line fit_line(const std::vector<double>& x, const std::vector<double>& y) {
  const auto n = static_cast<double>(x.size());
  double mx = 0, my = 0, xx = 0, xy = 0, yy = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    mx += x[i] / n;
    my += y[i] / n;
  }
  for (std::size_t i = 0; i < x.size(); ++i) {
    xx += (x[i] - mx) * (x[i] - mx);
    xy += (x[i] - mx) * (y[i] - my);
    yy += (y[i] - my) * (y[i] - my);
  }
  if (xx == 0 || yy == 0) return {};
  return {xy / xx, my - xy / xx * mx, xy * xy / (xx * yy)};
}

}  // namespace

void measure_time(const Case& at, const RunOptions& options, Recorder& recorder, Progress& progress) {
  const TerrainSource source = open_ground(at.terrain, options.seed);
  recorder.terrain(source);
  const Heightfield& ground = *source.heights;
  FlowNetwork network = route_flow(ground);
  std::vector<std::vector<double>> extraction(kTimedTaus.size());
  std::vector<double> regeneration;
  std::vector<Drills> drills(kTimedTaus.size());
  progress.begin("timing extraction", kSamples);
  // All thresholds in turn, so that a busy moment of the machine meets all alike; the first round warms up.
  for (int sample = -1; sample < kSamples; ++sample) {
    const double routing = seconds([&] { network = route_flow(ground); });
    if (sample >= 0) recorder.add("routing_time", "s", routing);
    for (std::size_t t = 0; t < kTimedTaus.size(); ++t) {
      DrillOptions extract;
      extract.tau = kTimedTaus[t];
      extract.k = 20;
      const double time = seconds([&] { drills[t] = extract_drills(ground, network, extract); });
      if (sample < 0) continue;
      extraction[t].push_back(time);
      recorder.add(fmt::format("extraction_time_tau_{}", extract.tau), "s", time);
      if (extract.tau != 25) continue;
      const double again = seconds([&] { regenerate(drills[t]); });
      regeneration.push_back(again);
      recorder.add("regeneration_time", "s", again);
    }
    if (sample >= 0) progress.advance();
  }
  std::vector<double> pixels, medians;
  double at_25 = 0;
  for (std::size_t t = 0; t < kTimedTaus.size(); ++t) {
    pixels.push_back(static_cast<double>(drills[t].count()));
    medians.push_back(summarise(extraction[t]).median);
    if (kTimedTaus[t] == 25) at_25 = medians.back();
  }
  const Line line = fit_line(pixels, medians);
  recorder.add("seconds_per_drill", "s", line.slope);
  recorder.add("seconds_without_drills", "s", line.intercept);
  recorder.add("r_squared", "", line.r_squared);
  recorder.add("extraction_to_regeneration", "", at_25 / summarise(regeneration).median);
}

}  // namespace terrabench::drill
