// The factorial of the drill paper's §3: 3 thresholds × 3 cross-sections × 6 influences, for each way to read
// the paper. The paper names only τ = 25, 100 and "above 100", w = 10 and k = 20; the other levels are our
// choice.
#pragma once

#include <array>
#include <functional>
#include <string>
#include <vector>

#include "experiments/experiment.h"
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
inline constexpr auto kVariantNames = [] {
  std::array<std::string_view, kVariants.size()> names;
  for (std::size_t i = 0; i < names.size(); ++i) names[i] = kVariants[i].name;
  return names;
}();
inline bool Variant::is_first() const { return name == kVariantNames[0]; }
// The three fits: the first three variants.
inline constexpr std::span<const Variant> kFits = std::span<const Variant>(kVariants).first(3);

ParameterSpec variant_parameter();
const Variant& variant_of(const Parameters&);

// For experiments that measure all fits: the parameter, and a case per ground and fit, named "GROUND" for the
// printed fit, otherwise "GROUND/FIT".
std::span<const ParameterSpec> fit_specs();
std::vector<Case> fit_cases(const RunOptions&);
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
  bool operator==(const Setting&) const = default;
};
DrillOptions options_for(const Setting&, const Variant& = kVariants[0]);

// The ways to read equation 3 and its divisor.
struct Reading {
  ChannelAverage average;
  ChannelSpace space;
  std::string name() const;  // such as "mean-plane"
};
inline constexpr std::array kReadings = [] {
  std::array<Reading, 12> all{};
  std::size_t at = 0;
  for (const auto average : {ChannelAverage::kMean, ChannelAverage::kLargest, ChannelAverage::kSum}) {
    for (const auto space : {ChannelSpace::kPlane, ChannelSpace::kPlaneSamples, ChannelSpace::kSpace,
                             ChannelSpace::kSpaceSamples}) {
      all[at++] = {average, space};
    }
  }
  return all;
}();

// Sets the factorial's k of least RMSE in `drills`, and returns its error.
ElevationError choose_influence_of_all(const Heightfield& ground, Drills& drills);

// The results of one setting. Errors are normalised as in §3.1.
struct Outcome {
  Setting setting;
  double rmse_metres = 0, rmse = 0;
  std::array<double, kReadings.size()> ahd{};  // infinite where one of the networks is empty
  std::size_t drills = 0;
  double untouched = 0;  // share of the samples with data that no drill touches
};
using ErrorOf = std::function<double(const Outcome&)>;

// The errors of the terrain that drills regenerate. `network` is variant.route(ground).
Outcome compare(const Heightfield& ground, const FlowNetwork& network, const Drills& drills,
                const Heightfield& regenerated, const Setting& setting, const Variant& variant);

// All 54, extracting once per τ and w. k varies fastest, then w, then τ.
std::vector<Outcome> factorial(const Heightfield& ground, const FlowNetwork& network, const Variant& variant,
                               Progress& progress);
// The same, kept until the program ends: many cases read the same 54. Not thread-safe.
const std::vector<Outcome>& factorial_of(const TerrainSource& source, const Variant& variant,
                                         Progress& progress);

}  // namespace terrabench::drill
