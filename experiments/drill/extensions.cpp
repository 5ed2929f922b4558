// The gain of what the drill paper's §4.1 leaves as future work: an influence per drill, interpolation of
// untouched pixels, channels that never rise downstream, and parameters chosen for a budget.
#include <fmt/format.h>

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

const std::array kSpecs{
    variant_parameter(),
    ParameterSpec{"tau", std::int64_t{25}, "pixels", "least flow of a channel", 1, 1e9},
    ParameterSpec{"adaptive_k", false, "", "a separate influence per drill, up to 30"},
    ParameterSpec{"interpolate_untouched", false, "", "interpolate pixels that no drill touches"},
    ParameterSpec{"monotone_profiles", false, "", "channels never rise downstream"},
    ParameterSpec{"choose", false, "", "tau, w and k chosen for the bytes of the paper's setting"},
};

// What is added to the paper's own method.
struct Extension {
  std::string_view name;
  bool adaptive_k, interpolate, monotone_profiles, choose = false;
};
constexpr std::array kAll{
    Extension{"one-influence", false, false, false},
    Extension{"own-influence", true, false, false},
    Extension{"interpolated", false, true, false},
    Extension{"own-influence-interpolated", true, true, false},
    Extension{"falling-channels", false, false, true},
};

struct Extended {
  int k = 0;
  std::size_t bytes = 0;
  double rmse = 0;
  std::size_t untouched = 0, pits = 0;
};

Extended regenerated(const Heightfield& ground, const Drills& drills) {
  ByteSink bytes;
  encode_drills(drills, bytes);
  const Heightfield terrain = regenerate(drills);
  Drills bare = drills;
  bare.interpolated = false;
  return {drills.k, bytes.bytes().size(), elevation_error(ground, terrain).rmse,
          count_untouched(drills, regenerate(bare).heights), count_pits(terrain)};
}

// With the best k of the factorial, unless every drill has its own.
Extended extended(const Heightfield& ground, const FlowNetwork& network, DrillOptions options) {
  if (options.adaptive_k) options.k = kInfluences.back();
  Drills drills = extract_drills(ground, network, options);
  quantise(drills, automatic_quantum(ground));
  if (!options.adaptive_k) choose_influence_of_all(ground, drills);
  return regenerated(ground, drills);
}

void record(const Extended& result, Recorder& recorder) {
  recorder.add("k", "samples", result.k);
  recorder.add("drill_bytes", "B", result.bytes);
  recorder.add("rmse", "m", result.rmse);
  recorder.add("untouched", "pixels", result.untouched);
  recorder.add("pits", "", result.pits);
}

// The best single k, and parameters chosen for the same number of bytes.
void record_choice(const Heightfield& ground, const FlowNetwork& network, const DrillOptions& options,
                   Recorder& recorder, Progress& progress) {
  const Extended one = extended(ground, network, options);
  const DrillChoice choice =
      choose_parameters(ground, network, {.bytes = one.bytes, .rmse = 0}, {.fit = options.fit}, &progress);
  recorder.add("budget", "B", one.bytes);
  recorder.add("drill_bytes", "B", choice.bytes);
  recorder.add("chosen_tau", "pixels", choice.options.tau);
  recorder.add("chosen_w", "samples", choice.options.w);
  recorder.add("k", "samples", choice.options.k);
  recorder.add("rmse", "m", choice.rmse);
  recorder.add("rmse_unchosen", "m", one.rmse);
}

// Interpolation can only gain where the best single k leaves samples untouched.
void record_gain(const Extended& interpolated, const Extended& one, Recorder& recorder) {
  recorder.add("untouched_without", "pixels", static_cast<double>(one.untouched));
  recorder.add("untouched_without_gain", "pixels",
               interpolated.rmse < one.rmse ? 0 : static_cast<double>(one.untouched));
}

void add_cases(const std::string& ground, const Variant& variant, std::vector<Case>& cases) {
  for (const std::uint32_t tau : kTaus) {
    const auto add = [&](const Extension& extension) {
      cases.push_back({fmt::format("{}/tau={}/{}", with_variant(ground, variant), tau, extension.name),
                       {kSpecs,
                        {{"variant", std::string(variant.name)},
                         {"tau", std::int64_t{tau}},
                         {"adaptive_k", extension.adaptive_k},
                         {"interpolate_untouched", extension.interpolate},
                         {"monotone_profiles", extension.monotone_profiles},
                         {"choose", extension.choose}}},
                       ground});
    };
    for (const Extension& extension : kAll) add(extension);
    if (tau == kTaus[1]) add({"chosen", false, false, false, true});
  }
}

std::vector<Case> cases(const RunOptions& options) {
  std::vector<Case> cases;
  for (const std::string& ground : grounds(options)) {
    for (const Variant& variant : kFits) add_cases(ground, variant, cases);
  }
  return cases;
}

void measure(const Case& test_case, const RunOptions& options, Recorder& recorder, Progress& progress) {
  const TerrainSource source = recorder.terrain(open_ground(test_case.terrain, options.seed));
  const Heightfield& ground = *source.heights;
  const Variant& variant = variant_of(test_case.parameters);
  const FlowNetwork network = variant.route(ground);
  const DrillOptions one{.tau = static_cast<std::uint32_t>(test_case.parameters.integer("tau")),
                         .fit = variant.fit};
  if (test_case.parameters.flag("choose")) return record_choice(ground, network, one, recorder, progress);
  DrillOptions extract = one;
  extract.monotone_profiles = test_case.parameters.flag("monotone_profiles");
  extract.adaptive_k = test_case.parameters.flag("adaptive_k");
  extract.interpolate_untouched = test_case.parameters.flag("interpolate_untouched");
  const Extended result = extended(ground, network, extract);
  record(result, recorder);
  if (extract.interpolate_untouched) record_gain(result, extended(ground, network, one), recorder);
}

}  // namespace

extern const Experiment kExtensions{"drill.extensions", "§4.1: what the paper leaves as future work", kSpecs,
                                    cases, measure};

}  // namespace terrabench::drill
