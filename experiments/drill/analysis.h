// What the drill paper's §3.1 concludes from the errors of its parameter sets.
#pragma once

#include <array>
#include <vector>

#include "experiments/drill/factorial.h"
#include "experiments/recorder.h"

namespace terrabench::drill {

// How the variance of an error over outcomes splits up (analysis of variance with one observation per cell):
// the share that the mean per level of each factor explains. What is left of 1 are interactions.
struct Effects {
  double tau = 0, w = 0, k = 0;  // all 0 when nothing varies
  std::array<double, 3> mean_at_tau{};
};
// `outcomes`: those of all_settings(), or all combinations of some of its levels.
Effects main_effects(const std::vector<Outcome>& outcomes, const ErrorOf& error);

const Outcome& least(const std::vector<Outcome>& outcomes, const ErrorOf& error);

// The outcomes of "good" parameters, "meaning none that create outliers in the error data": those that do not
// lie beyond the upper quartile by more than 1.5 times the distance of the quartiles (Tukey 1977).
std::vector<Outcome> without_outliers(const std::vector<Outcome>& outcomes, const ErrorOf& error);

// In how many (w, k), of 18, the error rises at each step of τ.
int rising_with_tau(const std::vector<Outcome>& outcomes, const ErrorOf& error);

// The number of different values. 54 when each parameter set gave a terrain of its own.
std::size_t distinct(const std::vector<Outcome>& outcomes, const ErrorOf& error);

// The range that §3.1 reports for both errors under good parameters.
inline constexpr double kPaperLeast = 0.015, kPaperMost = 0.025;

// Whether a reading of the AHD gives all that §3.1 says of it: half of the good sets in that range, values
// above 1, and a mean that rises with τ.
bool gives_all(const std::vector<Outcome>& outcomes, const ErrorOf& error);

// What every table of an error shows: the least, how many sets and what share of the good ones lie in the
// paper's range, how many lie above 1, the mean at each τ, in how many cases it rises, and the main effects.
// Where an error is infinite, that is recorded in place of them. Names of metrics begin with `prefix`;
// `unread`: those that no table or claim of the caller reads.
void record_error(const std::vector<Outcome>& outcomes, std::string_view prefix, const ErrorOf& error,
                  Recorder& recorder, std::initializer_list<std::string_view> unread = {});

}  // namespace terrabench::drill
