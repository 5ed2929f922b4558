#include "experiments/drill/factorial.h"

#include <fmt/format.h>

#include "experiments/drill/ground.h"
#include "experiments/experiment.h"
#include "representations/drill/pits.h"
#include "representations/drill/regenerate.h"
#include "terrain/hydrology/channels.h"
#include "terrain/metrics/elevation_error.h"

namespace terrabench::drill {
namespace {

constexpr std::array kSpecs{
    ParameterSpec{"tau", std::int64_t{25}, "pixels", "least flow of a channel", 1, 1e9},
    ParameterSpec{"w", std::int64_t{10}, "samples", "length of a cross-section", 1, 255},
    ParameterSpec{"k", std::int64_t{20}, "samples", "influence of a drill", 0, 255},
};

// The error under the options of another reading of "monotone".
double error_under(const DrillOptions& options, const Heightfield& ground, const FlowNetwork& network,
                   Progress& progress) {
  const Drills drills = extract_drills(ground, network, options, &progress);
  return elevation_error(ground, regenerate(drills)).normalised();
}

}  // namespace

DrillOptions options_for(const Setting& setting) {
  return {.tau = setting.tau, .w = setting.w, .k = setting.k};
}

Outcome compare(const Heightfield& ground, const FlowNetwork& network, const Heightfield& regenerated,
                const Setting& setting) {
  Outcome outcome;
  outcome.setting = setting;
  const ElevationError error = elevation_error(ground, regenerated);
  outcome.rmse_metres = error.rmse;
  outcome.rmse = error.normalised();
  const auto channels = channel_pixels(network, setting.tau);
  const auto others = channel_pixels(route_flow(regenerated), setting.tau);
  for (std::size_t r = 0; r < kReadings.size(); ++r) {
    outcome.ahd[r] = channel_distance(ground, channels, regenerated, others, kReadings[r]).normalised();
  }
  return outcome;
}

Effects main_effects(const std::vector<Outcome>& outcomes, ErrorOf error) {
  double mean = 0, total = 0;
  for (const Outcome& o : outcomes) mean += error(o);
  mean /= static_cast<double>(outcomes.size());
  for (const Outcome& o : outcomes) total += (error(o) - mean) * (error(o) - mean);
  if (total == 0) return {};
  // The sum of squares of the level means about the grand mean, as a share of the total.
  const auto between = [&](const auto& levels, auto factor, double* means) {
    double squares = 0;
    for (std::size_t l = 0; l < levels.size(); ++l) {
      double sum = 0, count = 0;
      for (const Outcome& o : outcomes) {
        if (o.setting.*factor != levels[l]) continue;
        sum += error(o);
        ++count;
      }
      if (count == 0) continue;
      if (means != nullptr) means[l] = sum / count;
      squares += count * (sum / count - mean) * (sum / count - mean);
    }
    return squares / total;
  };
  Effects effects;
  effects.tau = between(kTaus, &Setting::tau, effects.mean_at_tau.data());
  effects.w = between(kWidths, &Setting::w, nullptr);
  effects.k = between(kInfluences, &Setting::k, nullptr);
  effects.interactions = 1 - effects.tau - effects.w - effects.k;
  return effects;
}

std::vector<Outcome> factorial(const Heightfield& ground, const FlowNetwork& network, Progress& progress) {
  std::vector<Outcome> outcomes;
  for (const std::uint32_t tau : kTaus) {
    for (const int w : kWidths) {
      // The shapes do not depend on k.
      Drills drills = extract_drills(ground, network, options_for({tau, w, kInfluences.front()}), &progress);
      progress.begin(fmt::format("regenerating at tau={}, w={}", tau, w), kInfluences.size());
      for (const int k : kInfluences) {
        drills.k = k;
        const Heightfield regenerated = regenerate(drills);
        Outcome& outcome = outcomes.emplace_back(compare(ground, network, regenerated, {tau, w, k}));
        outcome.drills = drills.count();
        outcome.untouched = count_untouched(drills, regenerated.heights);
        progress.advance();
      }
    }
  }
  return outcomes;
}

namespace {

std::vector<Case> cases(const RunOptions& options) {
  std::vector<Case> cases;
  for (const std::string& ground : grounds(options)) {
    for (const std::uint32_t tau : kTaus) {
      for (const int w : kWidths) {
        for (const int k : kInfluences) {
          cases.push_back(
              {fmt::format("{}/tau={},w={},k={}", ground, tau, w, k),
               {kSpecs, {{"tau", std::int64_t{tau}}, {"w", std::int64_t{w}}, {"k", std::int64_t{k}}}},
               ground});
        }
      }
    }
  }
  return cases;
}

void measure(const Case& at, const RunOptions& options, Recorder& recorder, Progress& progress) {
  const TerrainSource source = recorder.terrain(open_ground(at.terrain, options.seed));
  const Heightfield& ground = *source.heights;
  const Setting setting{static_cast<std::uint32_t>(at.parameters.integer("tau")), at.integer("w"),
                        at.integer("k")};
  const FlowNetwork network = route_flow(ground, &progress);
  const Drills drills = extract_drills(ground, network, options_for(setting), &progress);
  const Heightfield regenerated = regenerate(drills);
  const Outcome outcome = compare(ground, network, regenerated, setting);

  recorder.add("drills", "", drills.count());
  recorder.add("rmse", "m", outcome.rmse_metres);
  recorder.add("rmse_normalised", "", outcome.rmse);
  for (std::size_t r = 0; r < kReadings.size(); ++r) {
    recorder.add(fmt::format("ahd_{}", name(kReadings[r])), "", outcome.ahd[r]);
  }
  // Two weaker readings of "monotone" than ours: shapes may fall outward.
  DrillOptions weaker = options_for(setting);
  weaker.monotone = Monotone::kWindow;
  recorder.add("rmse_monotone_in_window", "", error_under(weaker, ground, network, progress));
  weaker.monotone = Monotone::kNowhere;
  recorder.add("rmse_not_monotone", "", error_under(weaker, ground, network, progress));
  recorder.add("untouched_share", "",
               static_cast<double>(count_untouched(drills, regenerated.heights)) /
                   static_cast<double>(regenerated.heights.size()));
  recorder.add("pits", "", count_pits(regenerated).count);
}

}  // namespace

extern const Experiment kFactorial{"drill.factorial", "§3: the factorial of 54 parameter sets", kSpecs, cases,
                                   measure};

}  // namespace terrabench::drill
