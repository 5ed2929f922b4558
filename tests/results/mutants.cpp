#include "tests/results/mutants.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

#include "results/claims/evidence.h"
#include "results/store/statistics.h"

namespace terrabench {
namespace {

using Outcome = ConditionResult::Outcome;
using Samples = std::vector<double>;

constexpr std::string_view kNames[] = {"0", "1", "equal", "10 times as large", "a tenth", "not a number"};
constexpr Mutant kAll[] = {Mutant::kZero,    Mutant::kOne,   Mutant::kOther,
                           Mutant::kTenfold, Mutant::kTenth, Mutant::kNan};

double mutated(Mutant mutant, double value, double other) {
  switch (mutant) {
    case Mutant::kZero:
      return 0;
    case Mutant::kOne:
      return 1;
    case Mutant::kOther:
      return other;
    case Mutant::kTenfold:
      return value * 10;
    case Mutant::kTenth:
      return value / 10;
    case Mutant::kNan:
      break;
  }
  return std::numeric_limits<double>::quiet_NaN();
}

void fill(Samples& samples, double value) { std::ranges::fill(samples, value); }

// Whether the condition holds when these mutants act on its metrics. All samples of a metric are its median:
// as many as there are, up to those that decide on times.
class Trial {
 public:
  Trial(const Condition& condition, const Store& store) : store_(store) { one_.conditions = {condition}; }

  bool holds_for_all(Mutant mutant) const {
    return holds([&](std::span<Samples> metrics) {
      const double first = metrics[0][0];
      for (Samples& samples : metrics) fill(samples, mutated(mutant, samples[0], first));
    });
  }
  // Whether some mutant of this metric alone breaks the condition.
  bool depends_on(std::size_t metric) const {
    return std::ranges::any_of(kAll, [&](Mutant mutant) {
      if (mutant == Mutant::kNan) return false;  // breaks every comparison
      return !holds([&](std::span<Samples> metrics) {
        const double other = metrics[(metric + 1) % metrics.size()][0];
        fill(metrics[metric], mutated(mutant, metrics[metric][0], other));
      });
    });
  }

 private:
  bool holds(const Mutate& change) const {
    const auto mutate = [&](std::span<Samples> metrics) {
      for (Samples& samples : metrics) {
        const double middle = median(samples);
        samples.assign(std::min(samples.size(), kFewestSamples), middle);
      }
      if (!metrics.empty()) change(metrics);
    };
    return gather_evidence(one_, store_, store_.profile(), mutate).results[0].outcome == Outcome::kHolds;
  }

  const Store& store_;
  Claim one_;
};

bool is_figure(const Condition& condition) { return condition.kind == Condition::Kind::kFigure; }

// Whether the pictures were drawn and the metrics recorded that the condition needs.
bool is_measured(const Condition& condition, const Store& store) {
  if (is_figure(condition) && store.find_figure(condition.figure, store.profile()).second == nullptr) {
    return false;
  }
  return std::ranges::all_of(condition.operands, [&](const Operand& operand) {
    if (operand.is_number()) return true;
    const Record* const record = store.find(operand.experiment, operand.case_name, store.profile());
    return record != nullptr && record->find(operand.metric) != nullptr;
  });
}

bool is_measured(const Claim& claim, const Store& store) {
  if (claim.conditions.empty() || !claim.measured_in(store.profile())) return false;
  return std::ranges::all_of(claim.conditions,
                             [&](const Condition& condition) { return is_measured(condition, store); });
}

bool survives(const Claim& claim, const Store& store, Mutant mutant) {
  return std::ranges::all_of(claim.conditions, [&](const Condition& condition) {
    return is_figure(condition) || Trial(condition, store).holds_for_all(mutant);
  });
}

// Why a claim of which every condition is a figure judges no method.
std::string_view without_numbers(const Claim& claim) {
  const bool prints = std::ranges::any_of(claim.conditions, [](const Condition& condition) {
    return !condition.operands.empty() || !condition.brightness.empty();
  });
  return prints ? "reads pictures, and that they show what was recorded" : "reads pictures alone";
}

// Empty if the claim's check is strong enough.
std::string weakness(const Claim& claim, const Store& store) {
  for (const Mutant mutant : {Mutant::kZero, Mutant::kOne, Mutant::kNan}) {
    if (survives(claim, store, mutant)) return fmt::format("holds if all that it reads is {}", name(mutant));
  }
  for (const Condition& condition : claim.conditions) {
    if (is_figure(condition)) continue;
    const Trial trial(condition, store);
    std::size_t metric = 0;
    for (const Operand& operand : condition.operands) {
      if (operand.is_number()) continue;
      if (!trial.depends_on(metric++)) {
        return fmt::format("holds whatever {}/{}/{} is", operand.experiment, operand.case_name,
                           operand.metric);
      }
    }
  }
  return "";
}

}  // namespace

std::string_view name(Mutant mutant) { return kNames[static_cast<std::size_t>(mutant)]; }

std::vector<Survivor> survivors(const Store& store, std::span<const Paper> papers) {
  std::vector<Survivor> found;
  for (const Paper& paper : papers) {
    for (const Claim& claim : paper.claims) {
      if (!is_measured(claim, store)) continue;
      if (std::ranges::all_of(claim.conditions, is_figure)) {
        found.push_back({&claim, std::string(without_numbers(claim)), true});
        continue;
      }
      std::string reason = weakness(claim, store);
      if (!reason.empty()) found.push_back({&claim, std::move(reason)});
    }
  }
  return found;
}

}  // namespace terrabench
