// The 54 outcomes on one ground, for each way to read §2: best parameter sets, main effects, figures 1 to 4.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "experiments/drill/analysis.h"
#include "experiments/drill/figures.h"
#include "experiments/drill/ground.h"
#include "experiments/experiment.h"
#include "experiments/figures/maps.h"

namespace terrabench::drill {
namespace {

struct Measure {
  std::string_view prefix;
  ErrorOf of;
};

// The reading of AHD that needs the fewest assumptions, the mean in plan. Figures 3 and 4 show it.
const Measure kRmse{"rmse_", [](const Outcome&o) { return o.rmse; }},
    kAhd{"ahd_mean_plane_", [](const Outcome&o) { return o.ahd[0]; }};
static_assert(kReadings[0].average == ChannelAverage::kMean && kReadings[0].space == ChannelSpace::kPlane);

ErrorOf reading(ChannelAverage average, ChannelSpace space) {
  std::size_t at = 0;
  while (kReadings[at].average != average || kReadings[at].space != space) ++at;
  return [at](const Outcome& o) { return o.ahd[at]; };
}

// Whether a reading of AHD gives all that §3.1 says of it: half of the good sets in its range, values above
// 1, and a mean that rises with τ.
bool gives_all(const std::vector<Outcome>& outcomes, const ErrorOf& error) {
  const auto share = [&](const std::vector<Outcome>& of, double low, double high) {
    return static_cast<double>(std::count_if(
               of.begin(), of.end(), [&](const Outcome& o) { return error(o) >= low && error(o) <= high; })) /
           static_cast<double>(of.size());
  };
  const auto means = main_effects(outcomes, error).mean_at_tau;
  return share(without_outliers(outcomes, error), kPaperLeast, kPaperMost) >= 0.5 &&
         share(outcomes, std::nextafter(1.0, 2.0), std::numeric_limits<double>::max()) > 0 &&
         means[0] < means[1] && means[1] < means[2];
}

// The error at the paper's best w and k. The paper gives τ only as the densest network: the least over τ.
void record_at_paper_best(const std::vector<Outcome>& outcomes, Recorder& recorder) {
  double at = std::numeric_limits<double>::infinity();
  for (const Outcome& o : outcomes) {
    if (o.setting.w == 10 && o.setting.k == 20) at = std::min(at, o.rmse);
  }
  add_share(recorder, "rmse_at_w10_k20", at);
  // Flat ground has no error to divide by.
  const double best = least(outcomes, kRmse.of).rmse;
  if (best > 0) add_share(recorder, "rmse_at_w10_k20_to_least", at / best);
}

void draw(const Study& study, const std::vector<Outcome>& outcomes, Recorder& recorder) {
  if (study.variant.is_first()) {
    draw_channels(study, recorder);
    draw_cross_sections(study, recorder);
  }
  draw_best(study, least(outcomes, kRmse.of), least(outcomes, kAhd.of), recorder);
  draw_error_matrices(study, outcomes, recorder);
}

void measure(const Case& at, const RunOptions& options, Recorder& recorder, Progress& progress) {
  const TerrainSource source = recorder.terrain(open_ground(at.terrain, options.seed));
  const Variant& variant = variant_of(at.parameters);
  const std::vector<Outcome>& outcomes = factorial_of(source, variant, progress);

  record_error(outcomes, kRmse.prefix, kRmse.of, recorder);
  record_error(outcomes, kAhd.prefix, kAhd.of, recorder);
  using enum ChannelAverage;
  using enum ChannelSpace;
  record_error(outcomes, "ahd_mean_space_samples_", reading(kMean, kSpaceSamples), recorder);
  std::size_t complete = 0;
  for (const Reading& each : kReadings) complete += gives_all(outcomes, reading(each.average, each.space));
  recorder.add("readings_that_give_all", "", static_cast<double>(complete));
  record_at_paper_best(outcomes, recorder);

  if (variant.steepest) return;  // the paper's figures show its own networks
  const FlowNetwork network = variant.route(*source.heights);
  const std::string ground = figures::ground_suffix(at.terrain, kMainGround);
  const std::string fit = variant.is_first() ? "" : fmt::format(".{}", variant.name);
  draw({*source.heights, network, variant, source.name, fit + ground}, outcomes, recorder);
}

std::vector<Case> cases(const RunOptions& options) {
  std::vector<Case> cases;
  for (const std::string& ground : grounds(options)) {
    for (const Variant& variant : kVariants) {
      cases.push_back(
          {with_variant(ground, variant), {fit_specs(), {{"variant", std::string(variant.name)}}}, ground});
    }
  }
  return cases;
}

}  // namespace

extern const Experiment kEffects{"drill.effects", "§3.1: best sets, main effects, figures 1-4", fit_specs(),
                                 cases, measure};

}  // namespace terrabench::drill
