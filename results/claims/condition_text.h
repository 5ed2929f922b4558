// How the results of conditions (evidence.h) are worded. What holds is decided in evidence.cpp and passed in.
#pragma once

#include "results/claims/evidence.h"
#include "results/store/statistics.h"

namespace terrabench {

// An operand with its samples. A number has no name.
struct Quantity {
  std::vector<double> samples;
  std::string name, unit;
  bool timed = false;  // timed(Metric): varies from run to run
};
Quantity quantity(const Operand&, const Metric&, bool name_case);
// Whether the claim's metrics are of several cases, so that their names must say of which.
bool names_cases(const Claim&);

inline ConditionResult::Outcome outcome(bool holds) {
  return holds ? ConditionResult::Outcome::kHolds : ConditionResult::Outcome::kFails;
}
ConditionResult word_missing(const Operand&, bool name_case, const std::optional<WhyAbsent>&);
// within, ratio, growth: `s` was compared with the condition's range.
ConditionResult word_range(const Condition&, const std::vector<Quantity>&, const Summary& s, bool holds);
// equal, order: holds[i] tells whether medians i and i + 1 do. In short, shows the first pair that fails,
// else the pair `nearest`.
ConditionResult word_chain(bool equal, const std::vector<Quantity>&, const std::vector<double>& medians,
                           const std::vector<bool>& holds, std::size_t nearest);

}  // namespace terrabench
