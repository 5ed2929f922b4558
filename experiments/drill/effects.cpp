// The 54 outcomes on one ground: best parameter sets, main effects, figures.
#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <limits>

#include "experiments/drill/figures.h"
#include "experiments/drill/ground.h"
#include "experiments/experiment.h"
#include "experiments/figures/figure_id.h"

namespace terrabench::drill {
namespace {

struct Measure {
  std::string name;
  ErrorOf of;
};

const Measure kMeasures[] = {
    {"rmse", [](const Outcome& o) { return o.rmse; }},
    {"ahd_plane", [](const Outcome& o) { return o.ahd[0]; }},
    {"ahd_space", [](const Outcome& o) { return o.ahd[1]; }},
    {"ahd_sample", [](const Outcome& o) { return o.ahd[2]; }},
};
static_assert(kReadings[0] == ChannelReading::kPlane && kReadings[1] == ChannelReading::kSpace &&
              kReadings[2] == ChannelReading::kSample);

const Outcome& least(const std::vector<Outcome>& outcomes, const Measure& measure) {
  return *std::min_element(outcomes.begin(), outcomes.end(),
                           [&](const Outcome& a, const Outcome& b) { return measure.of(a) < measure.of(b); });
}

void record_measure(const std::vector<Outcome>& outcomes, const Measure& measure, Recorder& recorder) {
  const auto add = [&](std::string_view what, double value) {
    recorder.add(fmt::format("{}_{}", measure.name, what), "", value);
  };
  const Outcome& best = least(outcomes, measure);
  add("least", measure.of(best));
  add("best_tau", best.setting.tau);
  add("best_w", best.setting.w);
  add("best_k", best.setting.k);
  const auto add_effects = [&](const Effects& effects, std::string_view where) {
    add(fmt::format("effect_tau{}", where), effects.tau);
    add(fmt::format("effect_w{}", where), effects.w);
    add(fmt::format("effect_k{}", where), effects.k);
    add(fmt::format("effect_interactions{}", where), effects.interactions);
  };
  const Effects effects = main_effects(outcomes, measure.of);
  add_effects(effects, "");
  // The paper calls parameters good that create no outliers. With the least k much of the ground stays
  // plateau, which dominates the variance.
  std::vector<Outcome> good;
  std::copy_if(outcomes.begin(), outcomes.end(), std::back_inserter(good),
               [](const Outcome& o) { return o.setting.k > kInfluences.front(); });
  add_effects(main_effects(good, measure.of), "_without_outliers");
  for (std::size_t t = 0; t < kTaus.size(); ++t) {
    add(fmt::format("mean_at_tau_{}", kTaus[t]), effects.mean_at_tau[t]);
  }
}

void measure(const Case& at, const RunOptions& options, Recorder& recorder, Progress& progress) {
  const TerrainSource source = recorder.terrain(open_ground(at.terrain, options.seed));
  const FlowNetwork network = route_flow(*source.heights, &progress);
  const std::vector<Outcome> outcomes = factorial(*source.heights, network, progress);

  recorder.add("runs", "", outcomes.size());
  for (const Measure& measure : kMeasures) record_measure(outcomes, measure, recorder);
  // The paper's best set does not name τ, only the densest network.
  double at_paper_best = std::numeric_limits<double>::infinity();
  for (const Outcome& o : outcomes) {
    if (o.setting.w == 10 && o.setting.k == 20) at_paper_best = std::min(at_paper_best, o.rmse);
  }
  recorder.add("rmse_at_w10_k20", "", at_paper_best);
  // Flat ground has no error to divide by.
  if (const double best = least(outcomes, kMeasures[0]).rmse; best > 0) {
    recorder.add("rmse_at_w10_k20_to_least", "", at_paper_best / best);
  }

  const Study study{*source.heights, network, source.name, figures::ground_suffix(at.terrain, kMainGround)};
  draw_channels(study, recorder);
  draw_cross_sections(study, recorder);
  draw_best(study, least(outcomes, kMeasures[0]), least(outcomes, kMeasures[1]), recorder);
  draw_matrices(study, outcomes, recorder);
}

}  // namespace

extern const Experiment kEffects{
    "drill.effects", "§3.1: best sets, main effects, figures 1-4", {}, ground_cases, measure};

}  // namespace terrabench::drill
