// What no paper has: methods of several papers on the same ground. Here the level-of-detail methods, each
// tuned to the same screen-space error along the same path.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "experiments/experiment.h"

namespace terrabench::cross {

// What enters: every method as it comes, and those with an option worth a comparison of its own.
struct Entrant {
  std::string name;  // of its cases
  std::string method, options;
};
std::vector<Entrant> entrants();

// Ground × method × asked error; brute force, which has no error, once a ground; and for each ground a case
// that draws all methods.
extern const std::span<const ParameterSpec> kEqualErrorParameters;
std::vector<Case> equal_error_cases(const RunOptions&);
// Bisects the method's knob, then measures everything that it costs and shows.
void measure_equal_error(const Case&, const RunOptions&, Recorder&, Progress&);

}  // namespace terrabench::cross
