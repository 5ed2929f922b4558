#include "experiments/drill/factorial.h"

#include <fmt/format.h>

#include <cassert>
#include <cmath>
#include <map>
#include <tuple>

#include "experiments/drill/ground.h"
#include "representations/drill/pits.h"
#include "representations/drill/regenerate.h"
#include "terrain/hydrology/channels.h"
#include "terrain/hydrology/steepest.h"

namespace terrabench::drill {
namespace {

constexpr std::array kSpecs{
    ParameterSpec{"tau", std::int64_t{25}, "pixels", "least flow of a channel", 1, 1e9},
    ParameterSpec{"w", std::int64_t{10}, "samples", "length of a cross-section", 1, 255},
    ParameterSpec{"k", std::int64_t{20}, "samples", "influence of a drill", 0, 255},
};

double untouched_share(const Drills& drills, const Heightfield& regenerated) {
  std::size_t holes = 0;
  for (const HoleRun& hole : drills.holes) holes += hole.count;
  const std::size_t pixels = drills.pixels() - holes;
  if (pixels == 0) return 0;
  return static_cast<double>(count_untouched(drills, regenerated.heights)) / static_cast<double>(pixels);
}

}  // namespace

ParameterSpec variant_parameter() {
  return choice("variant", kVariantNames,
                "the reading of §2: how shapes are fitted; d8: on networks by steepest descent");
}

const Variant& variant_of(const Parameters& parameters) { return kVariants[parameters.choice("variant")]; }

void add_share(Recorder& recorder, std::string_view metric, double value) {
  if (std::isfinite(value)) recorder.add(metric, "", value);
}

std::span<const ParameterSpec> variant_specs() {
  static const std::array specs{variant_parameter()};
  return specs;
}

std::string with_variant(std::string_view ground, const Variant& variant) {
  return variant.is_first() ? std::string(ground) : fmt::format("{}/{}", ground, variant.name);
}

std::vector<Case> variant_cases(const RunOptions& options, std::span<const Variant> variants) {
  std::vector<Case> cases;
  for (const std::string& ground : grounds(options)) {
    for (const Variant& variant : variants) {
      cases.push_back({with_variant(ground, variant),
                       {variant_specs(), {{"variant", std::string(variant.name)}}},
                       ground});
    }
  }
  return cases;
}

std::vector<Setting> all_settings() {
  std::vector<Setting> all;
  for (const std::uint32_t tau : kTaus) {
    for (const int w : kWidths) {
      for (const int k : kInfluences) all.push_back({tau, w, k});
    }
  }
  return all;
}

FlowNetwork Variant::route(const Heightfield& ground) const {
  return steepest ? route_steepest(ground) : route_flow(ground);
}

DrillOptions options_for(const Setting& setting, const Variant& variant) {
  return {.tau = setting.tau, .w = setting.w, .k = setting.k, .fit = variant.fit};
}

ElevationError choose_influence_of_all(const Heightfield& ground, Drills& drills) {
  ElevationError least;
  int best = 0;
  for (const int k : kInfluences) {
    drills.k = k;
    const ElevationError error = elevation_error(ground, regenerate(drills));
    if (best != 0 && error.rmse >= least.rmse) continue;
    least = error;
    best = k;
  }
  drills.k = best;
  return least;
}

Outcome compare(const Heightfield& ground, const FlowNetwork& network, const Drills& drills,
                const Heightfield& regenerated, const Setting& setting, const Variant& variant) {
  Outcome outcome;
  outcome.setting = setting;
  const ElevationError error = elevation_error(ground, regenerated);
  outcome.rmse_metres = error.rmse;
  outcome.rmse = error.normalised();
  outcome.drills = drills.count();
  outcome.untouched = untouched_share(drills, regenerated);
  outcome.pits = count_pits(regenerated);
  const auto channels = channel_pixels(network, setting.tau);
  const auto others = channel_pixels(variant.route(regenerated), setting.tau);
  constexpr std::size_t kSpaces = 4;  // the readings of one average
  static_assert(kReadings.size() == 3 * kSpaces);
  for (std::size_t s = 0; s < kSpaces; ++s) {
    const ChannelDistance distance =
        channel_distance(ground, channels, regenerated, others, kReadings[s].space);
    for (std::size_t r = s; r < kReadings.size(); r += kSpaces) {
      assert(kReadings[r].space == kReadings[s].space);
      outcome.ahd[r] = distance.normalised(kReadings[r].average);
    }
  }
  return outcome;
}

const Outcome& outcome_of(const TerrainSource& source, const Variant& variant, const Setting& setting,
                          std::optional<FlowNetwork>& network) {
  static std::map<std::tuple<std::string, std::string_view, Setting>, Outcome> kept;
  const auto [at, is_new] = kept.try_emplace({source.checksum, variant.name, setting});
  if (is_new) {
    const Heightfield& ground = *source.heights;
    if (!network) network = variant.route(ground);
    const Drills drills = extract_drills(ground, *network, options_for(setting, variant));
    at->second = compare(ground, *network, drills, regenerate(drills), setting, variant);
  }
  return at->second;
}

std::vector<Outcome> factorial_of(const TerrainSource& source, const Variant& variant, Progress& progress) {
  std::optional<FlowNetwork> network;
  std::vector<Outcome> outcomes;
  const std::vector<Setting> settings = all_settings();
  progress.begin("the factorial, " + std::string(variant.words), settings.size());
  for (const Setting& setting : settings) {
    outcomes.push_back(outcome_of(source, variant, setting, network));
    progress.advance();
  }
  return outcomes;
}

namespace {

std::vector<Case> cases(const RunOptions& options) {
  std::vector<Case> cases;
  for (const std::string& ground : grounds(options)) {
    for (const auto& [tau, w, k] : all_settings()) {
      cases.push_back({fmt::format("{}/tau={},w={},k={}", ground, tau, w, k),
                       {kSpecs, {{"tau", std::int64_t{tau}}, {"w", std::int64_t{w}}, {"k", std::int64_t{k}}}},
                       ground});
    }
  }
  return cases;
}

void measure(const Case& test_case, const RunOptions& options, Recorder& recorder, Progress&) {
  const TerrainSource source = recorder.terrain(open_ground(test_case.terrain, options.seed));
  const Setting setting{static_cast<std::uint32_t>(test_case.parameters.integer("tau")),
                        test_case.integer("w"), test_case.integer("k")};
  std::optional<FlowNetwork> network;  // the same for all fits
  for (const Variant& variant : kFits) {
    const Outcome& outcome = outcome_of(source, variant, setting, network);
    const auto add = [&](std::string_view metric, double value) {
      add_share(recorder,
                fmt::format("{}{}", variant.is_first() ? "" : fmt::format("{}_", variant.name), metric),
                value);
    };
    add("drills", static_cast<double>(outcome.drills));
    add("rmse_normalised", outcome.rmse);
    for (const std::string_view name : {"mean-plane", "mean-space-samples", "largest-plane"}) {
      add(fmt::format("ahd_{}", name), outcome.ahd[reading(name)]);
    }
    add("untouched_share", outcome.untouched);
    add("pits", static_cast<double>(outcome.pits));
  }
}

}  // namespace

extern const Experiment kFactorial{"drill.factorial", "§3: the factorial of 54 parameter sets", kSpecs, cases,
                                   measure};

}  // namespace terrabench::drill
