// Parameters for a budget (Stuetzle & Franklin 2012, §4.1: "automatically determine the ideal value for each
// of these parameters").
#pragma once

#include <cstddef>

#include "representations/drill/extract.h"

namespace terrabench {

// One of the two is set; the other is 0.
struct DrillBudget {
  std::size_t bytes = 0;  // of encode_drills()
  double rmse = 0;        // metres
};

struct DrillChoice {
  DrillOptions options;
  float quantum = 0;
  // The resulting size and error.
  std::size_t bytes = 0;
  double rmse = 0;
  bool within_budget = false;
};

// Chooses tau, w and k of `options` and a quantum: under a budget of bytes those of the least error, under
// one of error those of the fewest bytes; when no candidate keeps the budget, the nearest to it. The
// candidates are eight τ, for each the best w and k of a small grid, and for that four quanta, since rounding
// hardly moves the best shape. About 400 regenerations: a few seconds for 400² samples, linear in pixels.
// Throws usage_error unless exactly one budget is given.
DrillChoice choose_parameters(const Heightfield& field, const FlowNetwork& network, const DrillBudget& budget,
                              const DrillOptions& options, Progress* progress = nullptr);

}  // namespace terrabench
