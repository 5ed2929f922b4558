// What the drill paper's §3.1 concludes from the errors of its parameter sets.
#pragma once

#include <array>
#include <vector>

#include "experiments/drill/factorial.h"
#include "experiments/recorder.h"

namespace terrabench::drill {

// How the variance of an error over outcomes splits up (analysis of variance with one observation per cell):
// the share that the mean per level of each factor explains; interactions explain the rest.
struct Effects {
  double tau = 0, w = 0, k = 0, interactions = 0;  // shares, sum 1; all 0 when nothing varies
  std::array<double, 3> mean_at_tau{};
};
// `outcomes`: those of factorial(), or all combinations of some of its levels.
Effects main_effects(const std::vector<Outcome>& outcomes, const ErrorOf& error);

const Outcome& least(const std::vector<Outcome>& outcomes, const ErrorOf& error);

// The outcomes of "good" parameters, "meaning none that create outliers in the error data": those that do not
// lie beyond the upper quartile by more than 1.5 times the distance of the quartiles (Tukey 1977).
std::vector<Outcome> without_outliers(const std::vector<Outcome>& outcomes, const ErrorOf& error);

// In how many (w, k) the error rises at each step of τ, of all (w, k).
struct Cases {
  int rising = 0, all = 0;
};
Cases rising_with_tau(const std::vector<Outcome>& outcomes, const ErrorOf& error);

// The number of different values. 54 when each parameter set gave a terrain of its own.
std::size_t distinct(const std::vector<Outcome>& outcomes, const ErrorOf& error);

// The range that §3.1 reports for both errors under good parameters.
inline constexpr double kPaperLeast = 0.015, kPaperMost = 0.025;

// Records all of the above and, of the good sets, the share within the paper's range. Names of metrics begin
// with `prefix`. Errors must be finite in all outcomes; otherwise nothing but `infinite_sets` is recorded.
void record_error(const std::vector<Outcome>& outcomes, std::string_view prefix, const ErrorOf& error,
                  Recorder& recorder);

}  // namespace terrabench::drill
