// The gain of what the drill paper's §4.1 leaves as future work: an influence per drill, interpolation of
// untouched pixels, channels that never rise downstream, and parameters chosen for a budget.
#include <fmt/format.h>

#include <limits>

#include "experiments/drill/factorial.h"
#include "experiments/drill/ground.h"
#include "experiments/experiment.h"
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
    ParameterSpec{"adaptive_k", false, "", "a separate influence per drill, up to 30"},
    ParameterSpec{"interpolate_untouched", false, "", "interpolate pixels that no drill touches"},
    ParameterSpec{"monotone_profiles", false, "", "channels never rise downstream"},
    ParameterSpec{"choose", false, "", "tau, w and k chosen for the bytes of the paper's setting"},
};

struct Variant {
  std::string_view name;
  bool adaptive_k, interpolate, monotone_profiles, choose = false;
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

// With the best k of the factorial, unless every drill has its own.
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
  recorder.add("drill_bytes", "B", result.bytes);
  recorder.add("rmse", "m", result.error.rmse);
  recorder.add("rmse_normalised", "", result.error.normalised());
  recorder.add("untouched", "pixels", result.untouched);
  recorder.add("pits", "", result.pits);
}

// The printed setting, and parameters chosen for the same number of bytes.
void record_choice(const Heightfield& ground, const FlowNetwork& network, std::uint32_t tau,
                   Recorder& recorder, Progress& progress) {
  const Extended printed = extended(ground, network, {.tau = tau});
  const DrillChoice choice =
      choose_parameters(ground, network, {.bytes = printed.bytes, .rmse = 0}, {}, &progress);
  recorder.add("budget", "B", printed.bytes);
  recorder.add("drill_bytes", "B", choice.bytes);
  recorder.add("chosen_tau", "pixels", choice.options.tau);
  recorder.add("chosen_w", "samples", choice.options.w);
  recorder.add("k", "samples", choice.options.k);
  recorder.add("rmse", "m", choice.rmse);
  recorder.add("rmse_unchosen", "m", printed.error.rmse);
}

std::vector<Case> cases(const RunOptions& options) {
  std::vector<Case> cases;
  for (const std::string& ground : grounds(options)) {
    for (const std::uint32_t tau : kTaus) {
      const auto add = [&](const Variant& variant) {
        cases.push_back({fmt::format("{}/tau={}/{}", ground, tau, variant.name),
                         {kSpecs,
                          {{"tau", std::int64_t{tau}},
                           {"adaptive_k", variant.adaptive_k},
                           {"interpolate_untouched", variant.interpolate},
                           {"monotone_profiles", variant.monotone_profiles},
                           {"choose", variant.choose}}},
                         ground});
      };
      for (const Variant& variant : kVariants) add(variant);
      if (tau == kTaus[1]) add({"chosen", false, false, false, true});
    }
  }
  return cases;
}

void measure(const Case& at, const RunOptions& options, Recorder& recorder, Progress& progress) {
  const TerrainSource source = recorder.terrain(open_ground(at.terrain, options.seed));
  const FlowNetwork network = route_flow(*source.heights, &progress);
  const auto tau = static_cast<std::uint32_t>(at.parameters.integer("tau"));
  if (at.parameters.flag("choose")) return record_choice(*source.heights, network, tau, recorder, progress);
  const DrillOptions extract{.tau = tau,
                             .monotone_profiles = at.parameters.flag("monotone_profiles"),
                             .adaptive_k = at.parameters.flag("adaptive_k"),
                             .interpolate_untouched = at.parameters.flag("interpolate_untouched")};
  record(extended(*source.heights, network, extract), recorder);
}

}  // namespace

extern const Experiment kExtensions{"drill.extensions", "§4.1: what the paper leaves as future work", kSpecs,
                                    cases, measure};

}  // namespace terrabench::drill
