// The factorial of the drill paper's §3: 3 thresholds × 3 cross-sections × 6 influences, for each way to read
// the paper. The paper names only τ = 25, 100 and "above 100", w = 10 and k = 20; the other levels are our
// choice.
#pragma once

#include <algorithm>
#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "experiments/cases.h"
#include "representations/drill/extract.h"
#include "terrain/heightfield.h"
#include "terrain/hydrology/flow.h"
#include "terrain/metrics/channel_distance.h"
#include "terrain/metrics/elevation_error.h"
#include "terrain/parameters.h"
#include "terrain/source.h"

namespace terrabench::drill {

inline constexpr std::array<std::uint32_t, 3> kTaus{25, 100, 200};
inline constexpr std::array<int, 3> kWidths{5, 10, 20};
inline constexpr std::array<int, 6> kInfluences{5, 10, 15, 20, 25, 30};

// The paper contradicts itself about shapes: §2.2 constrains the fit at the centre only, §4 calls shapes
// monotonically increasing, §4.1 counts four values per drill, which a parabola with its vertex at the pixel
// has. Its network is a hybrid of least-cost search and of plain steepest descent.
struct Variant {
  std::string_view name;   // the value of the parameter "variant"
  std::string_view words;  // for captions
  DrillFit fit;
  bool steepest = false;  // networks by route_steepest() in place of route_flow()

  FlowNetwork route(const Heightfield& ground) const;
  bool is_first() const;  // shapes as printed on least-cost networks
};
inline constexpr std::array kVariants{
    Variant{"printed", "shapes fitted as printed", DrillFit::kPrinted},
    Variant{"monotone", "monotone shapes", DrillFit::kMonotone},
    Variant{"vertex", "shapes with their vertex at the pixel", DrillFit::kVertex},
    Variant{"printed-d8", "shapes fitted as printed, networks by steepest descent", DrillFit::kPrinted, true},
    Variant{"monotone-d8", "monotone shapes, networks by steepest descent", DrillFit::kMonotone, true},
    Variant{"vertex-d8", "shapes with their vertex at the pixel, networks by steepest descent",
            DrillFit::kVertex, true},
};
inline constexpr std::array kVariantNames = names_of(kVariants);
inline bool Variant::is_first() const { return name == kVariantNames[0]; }
// The three fits: the first three variants.
inline constexpr std::span<const Variant> kFits = std::span<const Variant>(kVariants).first(3);

ParameterSpec variant_parameter();
const Variant& variant_of(const Parameters&);

// For experiments that measure several variants: the parameter, and a case per ground and variant, named
// "GROUND" for the first variant, otherwise "GROUND/VARIANT".
std::span<const ParameterSpec> variant_specs();
std::vector<Case> variant_cases(const RunOptions&, std::span<const Variant>);
inline std::vector<Case> fit_cases(const RunOptions& options) { return variant_cases(options, kFits); }
// `ground`, or with "/monotone" or the like behind it for another than the first variant.
std::string with_variant(std::string_view ground, const Variant&);

// Numbers stored for a drill. §4.1 counts four, as many as shapes with their vertex at the pixel have: x, y,
// elevation and curvature. The other shapes have a slope too.
inline std::size_t values_per_drill(DrillFit fit) { return fit == DrillFit::kVertex ? 4 : 5; }

// Records a metric without unit if it is finite: errors of a flat ground have no range to divide by, and of
// two networks one may be empty.
void add_share(Recorder&, std::string_view metric, double value);

struct Setting {
  std::uint32_t tau = 25;
  int w = 10, k = 20;
  auto operator<=>(const Setting&) const = default;
};
std::vector<Setting> all_settings();  // 54: k varies fastest, then w, then τ
DrillOptions options_for(const Setting&, const Variant& = kVariants[0]);

// The ways to read equation 3 and its divisor.
struct Reading {
  std::string_view name;  // the value of the parameter "reading"
  ChannelAverage average;
  ChannelSpace space;
};
inline constexpr std::array kReadings{
    Reading{"mean-plane", ChannelAverage::kMean, ChannelSpace::kPlane},
    Reading{"mean-plane-samples", ChannelAverage::kMean, ChannelSpace::kPlaneSamples},
    Reading{"mean-space", ChannelAverage::kMean, ChannelSpace::kSpace},
    Reading{"mean-space-samples", ChannelAverage::kMean, ChannelSpace::kSpaceSamples},
    Reading{"largest-plane", ChannelAverage::kLargest, ChannelSpace::kPlane},
    Reading{"largest-plane-samples", ChannelAverage::kLargest, ChannelSpace::kPlaneSamples},
    Reading{"largest-space", ChannelAverage::kLargest, ChannelSpace::kSpace},
    Reading{"largest-space-samples", ChannelAverage::kLargest, ChannelSpace::kSpaceSamples},
    Reading{"sum-plane", ChannelAverage::kSum, ChannelSpace::kPlane},
    Reading{"sum-plane-samples", ChannelAverage::kSum, ChannelSpace::kPlaneSamples},
    Reading{"sum-space", ChannelAverage::kSum, ChannelSpace::kSpace},
    Reading{"sum-space-samples", ChannelAverage::kSum, ChannelSpace::kSpaceSamples},
};
constexpr std::size_t reading(std::string_view name) {
  return static_cast<std::size_t>(std::ranges::find(kReadings, name, &Reading::name) - kReadings.begin());
}

// Sets the factorial's k of least RMSE in `drills`, and returns its error.
ElevationError choose_influence_of_all(const Heightfield& ground, Drills& drills);

// The results of one setting. Errors are normalised as in §3.1.
struct Outcome {
  Setting setting;
  double rmse_metres = 0, rmse = 0;
  std::array<double, kReadings.size()> ahd{};  // infinite where one of the networks is empty
  std::size_t drills = 0;
  double untouched = 0;  // share of the samples with data that no drill touches
  std::size_t pits = 0;  // of the regenerated terrain
};
using ErrorOf = std::function<double(const Outcome&)>;
inline ErrorOf ahd(std::size_t reading) {
  return [=](const Outcome& o) { return o.ahd[reading]; };
}

// The errors of the terrain that drills regenerate. `network` is variant.route(ground).
Outcome compare(const Heightfield& ground, const FlowNetwork& network, const Drills& drills,
                const Heightfield& regenerated, const Setting& setting, const Variant& variant);

// The outcome of drills that are extracted for one setting alone. It is kept until the program ends, as three
// experiments read the same ones. `network` is routed at the first that is not kept. Not thread-safe.
const Outcome& outcome_of(const TerrainSource& source, const Variant& variant, const Setting& setting,
                          std::optional<FlowNetwork>& network);
// Those of all settings, in their order.
std::vector<Outcome> factorial_of(const TerrainSource& source, const Variant& variant, Progress& progress);

}  // namespace terrabench::drill
