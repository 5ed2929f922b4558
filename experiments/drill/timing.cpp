// Time of extraction and regeneration against the number of drills (the drill paper's §3.1).
#include <fmt/format.h>

#include <array>

#include "experiments/drill/ground.h"
#include "experiments/experiment.h"
#include "experiments/stopwatch.h"
#include "representations/drill/extract.h"
#include "representations/drill/regenerate.h"
#include "results/statistics.h"
#include "terrain/hydrology/flow.h"

namespace terrabench::drill {
namespace {

constexpr int kSamples = 9;
constexpr std::array<std::uint32_t, 8> kTimedTaus{10, 15, 25, 50, 100, 200, 400, 800};
constexpr std::size_t kPaperTau = 2;  // 25: regeneration is timed there

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

void measure(const Case& at, const RunOptions& options, Recorder& recorder, Progress& progress) {
  const TerrainSource source = recorder.terrain(open_ground(at.terrain, options.seed));
  const Heightfield& ground = *source.heights;
  FlowNetwork network = route_flow(ground);
  std::vector<std::vector<double>> extraction(kTimedTaus.size());
  std::vector<double> regeneration;
  std::vector<Drills> drills(kTimedTaus.size());
  progress.begin("timing extraction", kSamples);
  // Thresholds alternate, so that a slow period of the machine affects all alike. The first round warms up.
  for (int sample = -1; sample < kSamples; ++sample) {
    const double routing = seconds([&] { network = route_flow(ground); });
    if (sample >= 0) recorder.add("routing_time", "s", routing);
    for (std::size_t t = 0; t < kTimedTaus.size(); ++t) {
      const DrillOptions extract{.tau = kTimedTaus[t], .k = 20};
      const double time = seconds([&] { drills[t] = extract_drills(ground, network, extract); });
      if (sample < 0) continue;
      extraction[t].push_back(time);
      recorder.add(fmt::format("extraction_time_tau_{}", extract.tau), "s", time);
      if (t != kPaperTau) continue;
      const double again = seconds([&] { regenerate(drills[t]); });
      regeneration.push_back(again);
      recorder.add("regeneration_time", "s", again);
    }
    if (sample >= 0) progress.advance();
  }
  std::vector<double> pixels, medians;
  for (std::size_t t = 0; t < kTimedTaus.size(); ++t) {
    pixels.push_back(static_cast<double>(drills[t].count()));
    medians.push_back(summarise(extraction[t]).median);
  }
  const Line line = fit_line(pixels, medians);
  recorder.add("seconds_per_drill", "s", line.slope);
  recorder.add("seconds_without_drills", "s", line.intercept);
  recorder.add("r_squared", "", line.r_squared);
  recorder.add("extraction_to_regeneration", "", medians[kPaperTau] / summarise(regeneration).median);
}

}  // namespace

extern const Experiment kTime{"drill.time", "§3.1: time against channel pixels", {}, ground_cases, measure};

}  // namespace terrabench::drill
