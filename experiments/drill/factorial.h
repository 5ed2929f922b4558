// The factorial of the drill paper's §3: 3 thresholds × 3 cross-sections × 6 influences. The paper names only
// τ = 25, 100 and "above 100", w = 10 and k = 20; the other levels are our choice.
#pragma once

#include <array>
#include <vector>

#include "representations/drill/extract.h"
#include "terrain/heightfield.h"
#include "terrain/hydrology/flow.h"
#include "terrain/metrics/channel_distance.h"

namespace terrabench::drill {

inline constexpr std::array<std::uint32_t, 3> kTaus{25, 100, 200};
inline constexpr std::array<int, 3> kWidths{5, 10, 20};
inline constexpr std::array<int, 6> kInfluences{5, 10, 15, 20, 25, 30};

struct Setting {
  std::uint32_t tau = 25;
  int w = 10, k = 20;
};
DrillOptions options_for(const Setting&);

inline constexpr std::array kReadings{ChannelReading::kPlane, ChannelReading::kSpace,
                                      ChannelReading::kSample};

// The results of one setting. Errors are normalised as in §3.1.
struct Outcome {
  Setting setting;
  double rmse_metres = 0, rmse = 0;
  std::array<double, kReadings.size()> ahd{};
  std::size_t drills = 0, untouched = 0;
};

// The errors of a regenerated terrain.
Outcome compare(const Heightfield& ground, const FlowNetwork& network, const Heightfield& regenerated,
                const Setting& setting);

// How the variance of an error over outcomes splits up (analysis of variance with one observation per cell):
// the share that the mean per level of each factor explains; interactions explain the rest.
struct Effects {
  double tau = 0, w = 0, k = 0, interactions = 0;  // shares, sum 1; all 0 when nothing varies
  std::array<double, 3> mean_at_tau{};
};
using ErrorOf = double (*)(const Outcome&);
// `outcomes`: those of factorial(), or all combinations of some of its levels.
Effects main_effects(const std::vector<Outcome>& outcomes, ErrorOf error);

// All 54, extracting once per τ and w. k varies fastest, then w, then τ.
std::vector<Outcome> factorial(const Heightfield& ground, const FlowNetwork& network, Progress& progress);

}  // namespace terrabench::drill
