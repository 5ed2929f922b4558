#include "experiments/drill/factorial.h"

#include <fmt/format.h>

#include "experiments/drill/drill.h"
#include "experiments/drill/ground.h"
#include "representations/drill/extract.h"
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

DrillOptions options_for(const Setting& setting) {
  DrillOptions options;
  options.tau = setting.tau;
  options.w = setting.w;
  options.k = setting.k;
  return options;
}

// The error when shapes may fall outward, in the two readings of "monotone" that are weaker than ours.
double unbound_error(const Heightfield& ground, const FlowNetwork& network, DrillOptions options,
                     Progress& progress) {
  const Drills drills = extract_drills(ground, network, options, &progress);
  return elevation_error(ground, regenerate(drills)).normalised();
}

}  // namespace

std::string name(const Setting& setting) {
  return fmt::format("tau={},w={},k={}", setting.tau, setting.w, setting.k);
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

constinit const std::span<const ParameterSpec> kFactorialParameters = kSpecs;

std::vector<Case> factorial_cases(const RunOptions& options) {
  std::vector<Case> cases;
  for (const std::string& ground : grounds(options)) {
    for (const std::uint32_t tau : kTaus) {
      for (const int w : kWidths) {
        for (const int k : kInfluences) {
          Case& added = cases.emplace_back(Case{fmt::format("{}/{}", ground, name({tau, w, k})),
                                                Parameters(kFactorialParameters), ground});
          added.parameters.set("tau", std::int64_t{tau});
          added.parameters.set("w", std::int64_t{w});
          added.parameters.set("k", std::int64_t{k});
        }
      }
    }
  }
  return cases;
}

void measure_factorial(const Case& at, const RunOptions& options, Recorder& recorder, Progress& progress) {
  const TerrainSource source = open_ground(at.terrain, options.seed);
  recorder.terrain(source);
  const Heightfield& ground = *source.heights;
  const Setting setting{static_cast<std::uint32_t>(at.parameters.integer("tau")),
                        static_cast<int>(at.parameters.integer("w")),
                        static_cast<int>(at.parameters.integer("k"))};
  const FlowNetwork network = route_flow(ground, &progress);
  const Drills drills = extract_drills(ground, network, options_for(setting), &progress);
  const Heightfield regenerated = regenerate(drills);
  const Outcome outcome = compare(ground, network, regenerated, setting);

  recorder.add("drills", "", static_cast<double>(drills.count()));
  recorder.add("rmse", "m", outcome.rmse_metres);
  recorder.add("rmse_normalised", "", outcome.rmse);
  for (std::size_t r = 0; r < kReadings.size(); ++r) {
    recorder.add(fmt::format("ahd_{}", name(kReadings[r])), "", outcome.ahd[r]);
  }
  DrillOptions unbound = options_for(setting);
  unbound.monotone = Monotone::kWindow;
  recorder.add("rmse_monotone_in_window", "", unbound_error(ground, network, unbound, progress));
  unbound.monotone = Monotone::kNowhere;
  recorder.add("rmse_not_monotone", "", unbound_error(ground, network, unbound, progress));
  recorder.add("untouched_share", "",
               static_cast<double>(count_untouched(drills, regenerated.heights)) /
                   static_cast<double>(regenerated.heights.size()));
  recorder.add("pits", "", static_cast<double>(count_pits(regenerated).count));
}

}  // namespace terrabench::drill
