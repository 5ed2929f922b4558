// Parameters for a budget (Stuetzle & Franklin 2012, §4.1: "automatically determine the ideal value for each
// of these parameters").
#pragma once

#include <cstddef>

#include "representations/drill/drills.h"

namespace terrabench {

// One of the two; the other is 0.
struct DrillBudget {
  std::size_t bytes = 0;  // of encode_drills()
  double rmse = 0;        // metres
};

struct DrillChoice {
  DrillOptions options;
  float quantum = 0;
  // What they come to.
  std::size_t bytes = 0;
  double rmse = 0;
  bool within_budget = false;
};

// Sets tau, w and k of `options` and a quantum: for a budget of bytes those of the least error, for one of
// error those of the fewest bytes; when nothing looked at keeps the budget, what comes nearest to it. Looks
// at eight τ, for each of them at every w and k of a small grid, and at four quanta for the best of these,
// since rounding hardly moves the best shape. Some 400 regenerations: a few seconds for 400², linear in
// pixels. Throws usage_error unless exactly one budget is given.
DrillChoice choose_parameters(const Heightfield& field, const FlowNetwork& network, const DrillBudget& budget,
                              const DrillOptions& options, Progress* progress = nullptr);

}  // namespace terrabench
