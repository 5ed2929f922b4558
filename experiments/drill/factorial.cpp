#include "experiments/drill/factorial.h"

#include <fmt/format.h>

#include <cassert>
#include <cmath>
#include <map>

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

std::span<const ParameterSpec> fit_specs() {
  static const std::array specs{variant_parameter()};
  return specs;
}

std::string with_variant(std::string_view ground, const Variant& variant) {
  return variant.is_first() ? std::string(ground) : fmt::format("{}/{}", ground, variant.name);
}

std::vector<Case> fit_cases(const RunOptions& options) {
  std::vector<Case> cases;
  for (const std::string& ground : grounds(options)) {
    for (const Variant& variant : kFits) {
      cases.push_back(
          {with_variant(ground, variant), {fit_specs(), {{"variant", std::string(variant.name)}}}, ground});
    }
  }
  return cases;
}

FlowNetwork Variant::route(const Heightfield& ground) const {
  return steepest ? route_steepest(ground) : route_flow(ground);
}

DrillOptions options_for(const Setting& setting, const Variant& variant) {
  return {.tau = setting.tau, .w = setting.w, .k = setting.k, .fit = variant.fit};
}

std::string Reading::name() const {
  return fmt::format("{}-{}", terrabench::name(average), terrabench::name(space));
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

std::vector<Outcome> factorial(const Heightfield& ground, const FlowNetwork& network, const Variant& variant,
                               Progress& progress) {
  std::vector<Outcome> outcomes;
  for (const std::uint32_t tau : kTaus) {
    for (const int w : kWidths) {
      // The shapes do not depend on k.
      Drills drills =
          extract_drills(ground, network, options_for({tau, w, kInfluences.front()}, variant), &progress);
      progress.begin(fmt::format("regenerating at tau={}, w={}", tau, w), kInfluences.size());
      for (const int k : kInfluences) {
        drills.k = k;
        outcomes.push_back(compare(ground, network, drills, regenerate(drills), {tau, w, k}, variant));
        progress.advance();
      }
    }
  }
  return outcomes;
}

const std::vector<Outcome>& factorial_of(const TerrainSource& source, const Variant& variant,
                                         Progress& progress) {
  static std::map<std::pair<std::string, std::string_view>, std::vector<Outcome>> kept;  // 12 kB each
  const auto key = std::pair(source.checksum, variant.name);
  if (const auto at = kept.find(key); at != kept.end()) return at->second;
  return kept[key] = factorial(*source.heights, variant.route(*source.heights), variant, progress);
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
  for (const Variant& variant : kFits) {
    const Drills drills = extract_drills(ground, network, options_for(setting, variant), &progress);
    const Heightfield regenerated = regenerate(drills);
    const Outcome outcome = compare(ground, network, drills, regenerated, setting, variant);
    const auto add = [&](std::string_view metric, double value) {
      const std::string prefix = variant.is_first() ? "" : fmt::format("{}_", variant.name);
      add_share(recorder, prefix + std::string(metric), value);
    };
    add("drills", static_cast<double>(drills.count()));
    add("rmse_normalised", outcome.rmse);
    for (std::size_t r = 0; r < kReadings.size(); ++r) {
      add(fmt::format("ahd_{}", kReadings[r].name()), outcome.ahd[r]);
    }
    add("untouched_share", outcome.untouched);
    add("pits", static_cast<double>(count_pits(regenerated).count));
  }
  // A weaker reading of "monotone": shapes may fall beyond the window.
  DrillOptions in_window = options_for(setting);
  in_window.fit = DrillFit::kMonotoneInWindow;
  const Heightfield weaker = regenerate(extract_drills(ground, network, in_window, &progress));
  add_share(recorder, "rmse_monotone_in_window", elevation_error(ground, weaker).normalised());
}

}  // namespace

extern const Experiment kFactorial{"drill.factorial", "§3: the factorial of 54 parameter sets", kSpecs, cases,
                                   measure};

}  // namespace terrabench::drill
