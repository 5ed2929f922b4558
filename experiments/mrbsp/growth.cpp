// §5: level of detail gains more on larger ground, visibility on rougher ground. A gain is the number of
// triangles drawn without the method divided by that with it.
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "experiments/experiment.h"
#include "experiments/ground.h"
#include "experiments/mrbsp/ground.h"
#include "terrain/sources/fractal/diamond_square.h"

namespace terrabench::mrbsp {
namespace {

constexpr std::array kLandSpecs{
    ParameterSpec{"n", std::int64_t{257}, "samples", "side of the ground", 65, 8193},
};
constexpr std::array kRoughnessSpecs{
    ParameterSpec{"relief", 600.0, "m", "largest displacement at the first level of the fractal", 0, 10000},
    ParameterSpec{"hurst", 0.9, "", "Hurst exponent: lower is rougher", 0, 1},
};
constexpr int kViews = 60, kSmallest = 129, kLargest = 2049, kSeeds = 3;

std::vector<Case> land_cases(const RunOptions& options) {
  std::vector<Case> cases;
  const int largest = options.profile == Profile::kPaper ? kLargest : 1025;
  for (int n = kSmallest; n <= largest; n = 2 * n - 1) {
    cases.push_back({fmt::format("n={}", n), {kLandSpecs, {{"n", std::int64_t{n}}}}});
  }
  return cases;
}

void measure_land(const Case& at, const RunOptions& options, Recorder& recorder, Progress& progress) {
  const int n = at.integer("n");
  // Grounds of all sizes share their middle.
  const int around = std::max(n, kLargest);
  const Heightfield ground =
      crop(noise_hills(around, options.seed), (around - n) / 2, (around - n) / 2, n, n);
  recorder.terrain("noise-hills", checksum(ground));
  // On every ground the walk has the extent that it has on the smallest.
  const float reach = 0.6F * (kSmallest - 1) / static_cast<float>(std::max(n, kSmallest) - 1);
  const std::vector<View> views = walk(ground, kViews, reach);
  Mrbsp lod(ground, {.holes = HoleRule::kPrinted}, progress);
  lod.tune(kFinest);
  const double all = mean_triangles(lod, views);
  lod.tune(kTunedSize);
  const double some = mean_triangles(lod, views);
  lod.tune(1);
  const double printed = mean_triangles(lod, views);
  recorder.add("triangles_all", "", lod.tree().triangles());
  recorder.add("gain", "", all / some);
  recorder.add("gain_as_printed", "", all / printed);
}

std::vector<Case> roughness_cases(const RunOptions&) {
  std::vector<Case> cases;
  for (const double relief : {5.0, 20.0, 80.0, 320.0, 1280.0}) {
    cases.push_back({fmt::format("relief={}", relief), {kRoughnessSpecs, {{"relief", relief}}}});
  }
  for (const double hurst : {0.9, 0.8, 0.7, 0.6}) {
    cases.push_back({fmt::format("hurst={}", hurst), {kRoughnessSpecs, {{"hurst", hurst}}}});
  }
  return cases;
}

void measure_roughness(const Case& at, const RunOptions& options, Recorder& recorder, Progress& progress) {
  using visibility::Mode;
  constexpr std::array kWays{Mode::kSampled, Mode::kConservative};
  double without = 0;
  std::array<double, kWays.size()> with{};
  for (int k = 0; k < kSeeds; ++k) {
    const Heightfield ground =
        fractal::diamond_square({.seed = options.seed + static_cast<std::uint64_t>(k),
                                 .side = kSide,
                                 .amplitude = static_cast<float>(at.parameters.number("relief")),
                                 .hurst = static_cast<float>(at.parameters.number("hurst"))});
    if (k == 0) recorder.terrain("diamond-square", checksum(ground));
    const std::vector<View> views = walk(ground, kViews);
    MrbspOptions how{.depth = kDepth, .holes = HoleRule::kPrinted};
    const auto mean_drawn = [&] {
      Mrbsp lod(ground, how, progress);
      lod.tune(kFinest);
      return mean_triangles(lod, views);
    };
    without += mean_drawn() / kSeeds;
    how.visibility = true;
    for (std::size_t way = 0; way < kWays.size(); ++way) {
      how.visible.mode = kWays[way];
      with[way] += mean_drawn() / kSeeds;
    }
  }
  for (std::size_t way = 0; way < kWays.size(); ++way)
    recorder.add(fmt::format("gain_{}", name_of(kWays[way])), "", without / with[way]);
}

}  // namespace

extern const Experiment kLand{"mrbsp.land", "§5: LOD's gain against the size of the land", kLandSpecs,
                              land_cases, measure_land};
extern const Experiment kRoughness{"mrbsp.roughness", "§5: visibility's gain against roughness",
                                   kRoughnessSpecs, roughness_cases, measure_roughness};

}  // namespace terrabench::mrbsp
