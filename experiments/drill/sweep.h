// The RMSE over a fine grid of w and k, for what the drill paper leaves open: the levels of its factorial.
#pragma once

#include <array>
#include <vector>

#include "experiments/drill/factorial.h"
#include "experiments/figures/sheet.h"

namespace terrabench::drill {

inline constexpr int kLeastK = 2, kMostK = 40;
inline constexpr int kSweptK = kMostK - kLeastK + 1;
// Every second length from 3 to 31, and the paper's 10 and our 20.
inline constexpr std::array kSweptWidths{3, 5, 7, 9, 10, 11, 13, 15, 17, 19, 20, 21, 23, 25, 27, 29, 31};

// rmse[t][w][k - kLeastK], normalised, at the t-th τ and w-th width.
struct Sweep {
  using Plane = std::array<std::array<double, kSweptK>, kSweptWidths.size()>;
  std::array<Plane, kTaus.size()> rmse{};

  double at(std::size_t tau, std::size_t width, int k) const {
    return rmse[tau][width][static_cast<std::size_t>(k - kLeastK)];
  }
};

// Regenerates for each τ, w and k: 1989 times. About 3 s on one core for 400² samples.
Sweep sweep(const Heightfield& ground, const FlowNetwork& network, const Variant& variant,
            Progress& progress);

// A factorial of 54 that the paper's words allow: τ = 25, 100 and 200, three widths of which one is 10, and
// six influences in equal steps of which one is 20.
struct Levels {
  std::array<std::size_t, 3> widths{};  // places in kSweptWidths
  std::array<int, 6> influences{};
};
std::vector<Levels> allowed_levels();

// In how many of the allowed factorials each statement of §3.1 about the RMSE holds.
struct Held {
  int all = 0;
  int best = 0;        // the least RMSE is at w = 10, k = 20
  int best_width = 0;  // it is at w = 10
  int tau_first = 0;   // τ explains more of the variance than w and than k
  int every_case = 0;  // the RMSE rises with τ in all 18 pairs of w and k
};
Held held(const Sweep&);

// A map of the RMSE over k and w at τ = 25 per sweep, with the least and the paper's best marked.
figures::Sheet sweep_sheet(std::span<const Sweep> sweeps, std::span<const Variant> variants);

}  // namespace terrabench::drill
