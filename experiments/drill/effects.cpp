// The 54 outcomes on one ground, for each way to read §2: best parameter sets, main effects, figures 1 to 4;
// and the averaged Hausdorff distance of equation 3 in each reading.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "experiments/drill/analysis.h"
#include "experiments/drill/figures.h"
#include "experiments/drill/ground.h"
#include "experiments/experiment.h"
#include "experiments/figures/maps.h"

namespace terrabench::drill {
namespace {

const ErrorOf kRmse = [](const Outcome& o) { return o.rmse; };
// The reading of AHD that needs the fewest assumptions, the mean in plan. Figures 3 and 4 show it.
const ErrorOf kPlaneAhd = ahd(reading("mean-plane")), kSpaceAhd = ahd(reading("mean-space-samples"));

bool finite(const std::vector<Outcome>& outcomes, const ErrorOf& error) {
  return std::ranges::all_of(outcomes, [&](const Outcome& o) { return std::isfinite(error(o)); });
}

void record_sets(const std::vector<Outcome>& outcomes, const std::string& prefix, const ErrorOf& error,
                 Recorder& recorder, std::initializer_list<std::string_view> unread = {}) {
  record_error(outcomes, prefix, error, recorder, unread);
  if (finite(outcomes, error))
    recorder.add(prefix + "good_sets", "", without_outliers(outcomes, error).size());
}

void record_best(const std::vector<Outcome>& outcomes, const std::string& prefix, const ErrorOf& error,
                 Recorder& recorder) {
  if (!finite(outcomes, error)) return;
  const Outcome& best = least(outcomes, error);
  recorder.add(prefix + "best_tau", "pixels", best.setting.tau);
  recorder.add(prefix + "best_w", "samples", best.setting.w);
  recorder.add(prefix + "best_k", "samples", best.setting.k);
  recorder.add(prefix + "best_untouched", "", best.untouched);
  // With the least k much of the ground stays plateau, which dominates the variance.
  std::vector<Outcome> wide = outcomes;
  std::erase_if(wide, [](const Outcome& o) { return o.setting.k == kInfluences.front(); });
  const Effects effects = main_effects(wide, error);
  recorder.add(prefix + "effect_tau_k_from_10", "", effects.tau);
  recorder.add(prefix + "effect_k_k_from_10", "", effects.k);
}

void draw(const Study& study, const std::vector<Outcome>& outcomes, Recorder& recorder) {
  if (study.variant.is_first()) {
    draw_channels(study, recorder);
    draw_cross_sections(study, recorder);
  }
  draw_best(study, least(outcomes, kRmse), least(outcomes, kPlaneAhd), recorder);
  draw_error_matrices(study, outcomes, recorder);
}

void measure(const Case& test_case, const RunOptions& options, Recorder& recorder, Progress& progress) {
  const TerrainSource source = recorder.terrain(open_ground(test_case.terrain, options.seed));
  const Variant& variant = variant_of(test_case.parameters);
  const std::vector<Outcome> outcomes = factorial_of(source, variant, progress);

  record_sets(outcomes, "rmse_", kRmse, recorder, {"sets_above_1"});
  record_best(outcomes, "rmse_", kRmse, recorder);
  record_best(outcomes, "ahd_mean_plane_", kPlaneAhd, recorder);
  record_sets(outcomes, "ahd_mean_plane_", kPlaneAhd, recorder);
  record_sets(outcomes, "ahd_mean_space_samples_", kSpaceAhd, recorder,
              {"least", "good_in_range", "cases_rising_with_tau"});
  recorder.add("ahd_mean_plane_distinct", "", distinct(outcomes, kPlaneAhd));
  recorder.add("ahd_mean_space_samples_distinct", "", distinct(outcomes, kSpaceAhd));
  std::size_t complete = 0;
  for (std::size_t r = 0; r < kReadings.size(); ++r) complete += gives_all(outcomes, ahd(r));
  recorder.add("readings_that_give_all", "", static_cast<double>(complete));

  if (variant.steepest) return;  // the paper's figures show its own networks
  const FlowNetwork network = variant.route(*source.heights);
  const std::string ground = figures::ground_suffix(test_case.terrain, kMainGround);
  const std::string fit = variant.is_first() ? "" : fmt::format(".{}", variant.name);
  draw({*source.heights, network, variant, source.name, fit + ground}, outcomes, recorder);
}

constexpr std::array kReadingNames = names_of(kReadings);
const std::array kReadingSpecs{
    variant_parameter(),
    choice("reading", kReadingNames, "how distances are averaged, and in which space they are taken"),
};

// The ground comes last, so that a claim about a reading is judged on the claims' ground alone: twelve
// readings of three variants are many rows, and tables show them on the other grounds.
std::vector<Case> reading_cases(const RunOptions& options) {
  std::vector<Case> cases;
  for (const std::string& ground : grounds(options)) {
    for (const Variant& variant : kVariants) {
      for (const Reading& reading : kReadings) {
        cases.push_back({fmt::format("{}/{}/{}", variant.name, reading.name, ground),
                         {kReadingSpecs,
                          {{"variant", std::string(variant.name)}, {"reading", std::string(reading.name)}}},
                         ground});
      }
    }
  }
  return cases;
}

void measure_reading(const Case& test_case, const RunOptions& options, Recorder& recorder,
                     Progress& progress) {
  const TerrainSource source = recorder.terrain(open_ground(test_case.terrain, options.seed));
  const auto outcomes = factorial_of(source, variant_of(test_case.parameters), progress);
  record_error(outcomes, "", ahd(test_case.parameters.choice("reading")), recorder);
}

}  // namespace

extern const Experiment kEffects{
    "drill.effects", "§3.1: best sets, main effects, figures 1-4", variant_specs(),
    [](const RunOptions& options) { return variant_cases(options, kVariants); }, measure};
extern const Experiment kAhdReadings{"drill.readings", "§3: the readings of the averaged Hausdorff distance",
                                     kReadingSpecs, reading_cases, measure_reading};

}  // namespace terrabench::drill
