// The factorial of the drill paper's §3: 3 thresholds × 3 cross-sections × 6 influences. The paper names τ =
// 25 and 100 and "above 100", w = 10 and k = 20 only; the other levels are our choice around these.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "representations/drill/drills.h"
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
std::string name(const Setting&);  // "tau=25,w=10,k=20"

inline constexpr std::array kReadings{ChannelReading::kPlane, ChannelReading::kSpace,
                                      ChannelReading::kSample};

// What one setting measures. Errors are normalised as in §3.1.
struct Outcome {
  Setting setting;
  double rmse_metres = 0, rmse = 0;
  std::array<double, kReadings.size()> ahd{};
  std::size_t drills = 0, untouched = 0;
};

// The errors of a regenerated terrain against its ground.
Outcome compare(const Heightfield& ground, const FlowNetwork& network, const Heightfield& regenerated,
                const Setting& setting);

// A split of the variance of an error over the 54 outcomes: the share that the mean of each factor's
// levels explains, and what is left to interactions (analysis of variance with one observation a cell).
struct Effects {
  double tau = 0, w = 0, k = 0, interactions = 0;  // shares, sum 1; all 0 when nothing varies
  std::array<double, 3> mean_at_tau{};
};
// `outcomes`: those of factorial(), or of some of its levels with all combinations of these.
template <class ErrorOf>
Effects main_effects(const std::vector<Outcome>& outcomes, const ErrorOf& error);

// All 54, extracting once for each τ and w. k varies fastest, then w, then τ.
std::vector<Outcome> factorial(const Heightfield& ground, const FlowNetwork& network, Progress& progress);

template <class ErrorOf>
Effects main_effects(const std::vector<Outcome>& outcomes, const ErrorOf& error) {
  double mean = 0, total = 0;
  for (const Outcome& o : outcomes) mean += error(o);
  mean /= static_cast<double>(outcomes.size());
  for (const Outcome& o : outcomes) total += (error(o) - mean) * (error(o) - mean);
  if (total == 0) return {};
  // Sum of squares of the level means about the grand mean.
  const auto between = [&](const auto& levels, const auto& level_of, double* means) {
    double squares = 0;
    for (std::size_t l = 0; l < levels.size(); ++l) {
      double sum = 0, count = 0;
      for (const Outcome& o : outcomes) {
        if (level_of(o.setting) != levels[l]) continue;
        sum += error(o);
        ++count;
      }
      if (count == 0) continue;
      if (means != nullptr) means[l] = sum / count;
      squares += count * (sum / count - mean) * (sum / count - mean);
    }
    return squares / total;
  };
  Effects effects;
  effects.tau = between(
      kTaus, [](const Setting& s) { return s.tau; }, effects.mean_at_tau.data());
  effects.w = between(
      kWidths, [](const Setting& s) { return s.w; }, nullptr);
  effects.k = between(
      kInfluences, [](const Setting& s) { return s.k; }, nullptr);
  effects.interactions = 1 - effects.tau - effects.w - effects.k;
  return effects;
}

}  // namespace terrabench::drill
