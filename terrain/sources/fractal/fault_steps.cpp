#include "terrain/sources/fractal/fault_steps.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "terrain/error.h"
#include "terrain/sources/fractal/limits.h"

namespace terrabench::fractal {

FaultSteps fault_steps(int faults, float step, float decay, float least, std::string_view where) {
  constexpr int kMostFaults = 1'000'000;
  constexpr double kUnits = 1 << 20;  // of the first step: sums of a million of them stay below 2^53
  check_between(faults, 0, kMostFaults, "faults", where);
  check_between(step, 0, kLargestMetres, "step", where);
  check_between(decay, 1e-3, 1, "decay", where);
  check_between(least, 0, kLargestMetres, "least_step", where);
  if (least > step) {
    throw usage_error(fmt::format("least_step must be at most step, {} m, got {} m", step, least), where,
                      "steps shrink from step to least_step");
  }
  FaultSteps steps;
  steps.unit = step / kUnits;
  const double lowest = step > 0 ? static_cast<double>(least) / step : 0;
  double share = 1;
  for (int k = 0; k < faults; ++k) {
    steps.whole.push_back(std::llround(std::max(share, lowest) * kUnits));
    share *= decay;
  }
  return steps;
}

void write_row(const FaultSteps& steps, std::int64_t sum, std::vector<std::int64_t>& turns, int width,
               float* row) {
  for (int i = 0; i < width; ++i) {
    const auto at = static_cast<std::size_t>(i);
    sum += turns[at];
    row[at] = steps.metres(sum);
  }
  std::fill(turns.begin(), turns.end(), 0);
}

}  // namespace terrabench::fractal
