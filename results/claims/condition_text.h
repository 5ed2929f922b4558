// How the results of conditions (evidence.h) are worded. What holds is decided in evidence.cpp and passed in.
#pragma once

#include <optional>

#include "results/claims/evidence.h"
#include "results/store/statistics.h"

namespace terrabench {

// An operand with its samples. A number has no name.
struct Quantity {
  std::vector<double> samples;
  std::string name, unit;
  bool timed = false;  // timed(Metric): varies from run to run
  Order order = Order::kIndependent;
  std::string of = {};  // experiment and case
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
// From one median of an order to the next; `ratio`: of the next time to this one, where both are times.
struct ChainStep {
  bool holds = false;
  std::optional<Summary> ratio;
};
// equal, order: steps[i] leads from median i to i + 1. In short, shows the first pair that fails, else the
// pair `nearest`.
ConditionResult word_chain(bool equal, const std::vector<Quantity>&, const std::vector<double>& medians,
                           const std::vector<ChainStep>& steps, std::size_t nearest);

}  // namespace terrabench
