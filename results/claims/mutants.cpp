#include "results/claims/mutants.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <limits>
#include <utility>

#include "results/claims/evidence.h"
#include "results/store/statistics.h"

namespace terrabench {
namespace {

using Outcome = Finding::Outcome;
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

// The metrics that a condition reads, in the order of Mutate; of a figure, those of `prints` and
// `brightness`.
std::vector<Operand> metrics_of(const Condition& condition) {
  std::vector<Operand> metrics;
  for (const auto* const operands : {&condition.operands, &condition.brightness}) {
    std::ranges::copy_if(*operands, std::back_inserter(metrics), std::not_fn(&Operand::is_number));
  }
  return metrics;
}

const Metric* find(const Operand& operand, const Store& store) {
  const Record* const record = store.find(operand.experiment, operand.case_name, store.profile());
  return record == nullptr ? nullptr : record->find(operand.metric);
}

// Whether the condition holds when these mutants act on its metrics, all of which were measured. Medians
// decide, so one sample is enough.
class Trial {
 public:
  Trial(const Condition& condition, const Store& store) : store_(store) { one_.conditions = {condition}; }

  bool holds_for_all(Mutant mutant) const {
    return holds([&](std::span<Samples> metrics) {
      const double first = metrics[0][0];
      for (Samples& samples : metrics) samples[0] = mutated(mutant, samples[0], first);
    });
  }
  // Whether some mutant of this metric alone breaks the condition.
  bool depends_on(std::size_t metric) const {
    return std::ranges::any_of(kAll, [&](Mutant mutant) {
      if (mutant == Mutant::kNan) return false;  // breaks every comparison
      return !holds([&](std::span<Samples> metrics) {
        const double other = metrics[(metric + 1) % metrics.size()][0];
        metrics[metric][0] = mutated(mutant, metrics[metric][0], other);
      });
    });
  }

 private:
  bool holds(const Mutate& change) const {
    if (one_.conditions[0].kind == Condition::Kind::kFigure) return figure_holds(change);
    const auto mutate = [&](std::span<Samples> metrics) {
      for (Samples& samples : metrics) samples = {median(samples)};
      if (!metrics.empty()) change(metrics);
    };
    return gather_evidence(one_, store_, store_.profile(), mutate).findings[0].outcome == Outcome::kHolds;
  }

  // Whether the figure, as drawn, would show the metrics as changed. Reads its layout, not its pixels.
  bool figure_holds(const Mutate& change) const {
    const Condition& figure = one_.conditions[0];
    std::vector<Samples> metrics;
    for (const Operand& operand : metrics_of(figure)) {
      metrics.push_back({median(find(operand, store_)->samples)});
    }
    if (metrics.empty()) return true;
    const std::vector<Samples> measured = metrics;
    change(metrics);
    const auto& layout = store_.find_figure(figure.figure, store_.profile()).second->layout;
    for (std::size_t k = 0; k < metrics.size(); ++k) {
      const bool is_brightness = k >= figure.operands.size();
      const bool shown = is_brightness ? std::abs(metrics[k][0] - measured[k][0]) <= Condition::kBrightness
                                       : layout && says(*layout, metrics[k][0]);
      if (!shown) return false;
    }
    return true;
  }

  const Store& store_;
  Claim one_;
};

bool is_measured(const Claim& claim, const Store& store) {
  if (claim.conditions.empty() || std::ranges::count(claim.profiles, store.profile()) == 0) return false;
  return std::ranges::all_of(claim.conditions, [&](const Condition& condition) {
    const bool drawn = condition.kind != Condition::Kind::kFigure ||
                       store.find_figure(condition.figure, store.profile()).second != nullptr;
    return drawn && std::ranges::all_of(metrics_of(condition), [&](const Operand& metric) {
             return find(metric, store) != nullptr;
           });
  });
}

bool reads_metrics(const Claim& claim) {
  return std::ranges::any_of(claim.conditions,
                             [](const Condition& condition) { return !metrics_of(condition).empty(); });
}

bool survives(const Claim& claim, const Store& store, Mutant mutant) {
  return std::ranges::all_of(claim.conditions, [&](const Condition& condition) {
    return Trial(condition, store).holds_for_all(mutant);
  });
}

// Empty if the claim's check is strong enough.
std::string weakness(const Claim& claim, const Store& store) {
  for (const Mutant mutant : {Mutant::kZero, Mutant::kOne, Mutant::kNan}) {
    if (survives(claim, store, mutant)) return fmt::format("holds if all that it reads is {}", name(mutant));
  }
  for (const Condition& condition : claim.conditions) {
    const Trial trial(condition, store);
    const std::vector<Operand> metrics = metrics_of(condition);
    for (std::size_t k = 0; k < metrics.size(); ++k) {
      if (trial.depends_on(k)) continue;
      return fmt::format("holds whatever {}/{}/{} is", metrics[k].experiment, metrics[k].case_name,
                         metrics[k].metric);
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
      if (!reads_metrics(claim)) {
        found.push_back({&claim, "reads pictures alone", true});
        continue;
      }
      std::string reason = weakness(claim, store);
      if (!reason.empty()) found.push_back({&claim, std::move(reason)});
    }
  }
  return found;
}

}  // namespace terrabench
