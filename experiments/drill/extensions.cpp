// What the drill paper's §4.1 leaves as future work, each for what it gains: an influence for every drill,
// interpolation of what no drill touches, channels that never rise downstream, and parameters chosen for a
// budget.
#include <fmt/format.h>

#include <limits>

#include "experiments/drill/drill.h"
#include "experiments/drill/factorial.h"
#include "experiments/drill/ground.h"
#include "representations/drill/choose_parameters.h"
#include "representations/drill/drill_codec.h"
#include "representations/drill/extract.h"
#include "representations/drill/pits.h"
#include "representations/drill/quantum.h"
#include "representations/drill/regenerate.h"
#include "terrain/metrics/elevation_error.h"

namespace terrabench::drill {
namespace {

constexpr std::array kSpecs{
    ParameterSpec{"tau", std::int64_t{25}, "pixels", "least flow of a channel", 1, 1e9},
    ParameterSpec{"adaptive_k", false, "", "an influence of its own for every drill, up to 30"},
    ParameterSpec{"interpolate_untouched", false, "", "draw what no drill touches from its surroundings"},
    ParameterSpec{"monotone_profiles", false, "", "channels never rise downstream"},
    ParameterSpec{"choose", false, "", "tau, w and k chosen for the bytes of the paper's setting"},
};

struct Variant {
  std::string_view name;
  bool adaptive_k, interpolate, monotone_profiles;
};
constexpr std::array kVariants{
    Variant{"as-printed", false, false, false},      Variant{"own-influence", true, false, false},
    Variant{"interpolated", false, true, false},     Variant{"own-influence-interpolated", true, true, false},
    Variant{"falling-channels", false, false, true},
};

struct Extended {
  int k = 0;
  std::size_t bytes = 0;
  ElevationError error;
  std::size_t untouched = 0, pits = 0;
};

Extended regenerated(const Heightfield& ground, const Drills& drills) {
  ByteSink bytes;
  encode_drills(drills, bytes);
  const Heightfield terrain = regenerate(drills);
  Drills bare = drills;
  bare.interpolated = false;
  return {drills.k, bytes.bytes().size(), elevation_error(ground, terrain),
          count_untouched(drills, regenerate(bare).heights), count_pits(terrain).count};
}

// Under the best single k of the factorial, unless every drill has its own.
Extended extended(const Heightfield& ground, const FlowNetwork& network, DrillOptions options) {
  if (options.adaptive_k) options.k = kInfluences.back();
  Drills drills = extract_drills(ground, network, options);
  quantise(drills, automatic_quantum(ground));
  if (options.adaptive_k) return regenerated(ground, drills);
  Extended best;
  best.error.rmse = std::numeric_limits<double>::infinity();
  for (const int k : kInfluences) {
    drills.k = k;
    const Extended at = regenerated(ground, drills);
    if (at.error.rmse < best.error.rmse) best = at;
  }
  return best;
}

void record(const Extended& result, Recorder& recorder) {
  recorder.add("k", "samples", result.k);
  recorder.add("drill_bytes", "B", static_cast<double>(result.bytes));
  recorder.add("rmse", "m", result.error.rmse);
  recorder.add("rmse_normalised", "", result.error.normalised());
  recorder.add("untouched", "pixels", static_cast<double>(result.untouched));
  recorder.add("pits", "", static_cast<double>(result.pits));
}

// The setting that the paper prints, and what a choice makes of as many bytes.
void record_choice(const Heightfield& ground, const FlowNetwork& network, std::uint32_t tau,
                   Recorder& recorder, Progress& progress) {
  DrillOptions options;
  options.tau = tau;
  const Extended printed = extended(ground, network, options);
  const DrillChoice choice =
      choose_parameters(ground, network, {.bytes = printed.bytes, .rmse = 0}, {}, &progress);
  recorder.add("budget", "B", static_cast<double>(printed.bytes));
  recorder.add("drill_bytes", "B", static_cast<double>(choice.bytes));
  recorder.add("chosen_tau", "pixels", choice.options.tau);
  recorder.add("chosen_w", "samples", choice.options.w);
  recorder.add("k", "samples", choice.options.k);
  recorder.add("rmse", "m", choice.rmse);
  recorder.add("rmse_unchosen", "m", printed.error.rmse);
}

}  // namespace

constinit const std::span<const ParameterSpec> kExtensionParameters = kSpecs;

std::vector<Case> extension_cases(const RunOptions& options) {
  std::vector<Case> cases;
  for (const std::string& ground : grounds(options)) {
    for (const std::uint32_t tau : kTaus) {
      const auto add = [&](std::string_view name) -> Parameters& {
        Case& added = cases.emplace_back(
            Case{fmt::format("{}/tau={}/{}", ground, tau, name), Parameters(kExtensionParameters), ground});
        added.parameters.set("tau", std::int64_t{tau});
        return added.parameters;
      };
      for (const Variant& variant : kVariants) {
        Parameters& parameters = add(variant.name);
        parameters.set("adaptive_k", variant.adaptive_k);
        parameters.set("interpolate_untouched", variant.interpolate);
        parameters.set("monotone_profiles", variant.monotone_profiles);
      }
      if (tau == kTaus[1]) add("chosen").set("choose", true);
    }
  }
  return cases;
}

void measure_extension(const Case& at, const RunOptions& options, Recorder& recorder, Progress& progress) {
  const TerrainSource source = open_ground(at.terrain, options.seed);
  recorder.terrain(source);
  const FlowNetwork network = route_flow(*source.heights, &progress);
  const auto tau = static_cast<std::uint32_t>(at.parameters.integer("tau"));
  if (at.parameters.flag("choose")) return record_choice(*source.heights, network, tau, recorder, progress);
  DrillOptions extract;
  extract.tau = tau;
  extract.adaptive_k = at.parameters.flag("adaptive_k");
  extract.interpolate_untouched = at.parameters.flag("interpolate_untouched");
  extract.monotone_profiles = at.parameters.flag("monotone_profiles");
  record(extended(*source.heights, network, extract), recorder);
}

}  // namespace terrabench::drill
