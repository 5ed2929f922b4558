#include "results/claims/condition_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "results/store/format.h"

namespace terrabench {
namespace {

std::string spoken(std::string metric) {
  std::replace(metric.begin(), metric.end(), '_', ' ');
  return metric;
}

std::string show(const Quantity& q, double value) {
  const std::string text = format_quantity(printed(value, q.timed), q.unit);
  return q.name.empty() ? text : q.name + " " + text;
}

// How far a value misses a bound: relative to the bound unless that is 0, and as a factor from 3 on.
std::string missed_by(double value, double bound) {
  const double distance = value - bound;
  if (!std::isfinite(distance)) return "at no finite distance";
  const std::string_view side = distance < 0 ? "below" : "above";
  if (bound != 0 && value / bound >= 3)
    return fmt::format("{} times that", format_number(std::round(100 * value / bound) / 100));
  return bound == 0 ? fmt::format("{:.3g} {}", std::abs(distance), side)
                    : fmt::format("{:.3g} % {}", 100 * std::abs(distance / bound), side);
}

// Of a step that does not hold: by how much, or what is known instead of two times' order.
std::string why_not(const ChainStep& step, double from, double to, bool in_order) {
  if (!in_order) return from == to ? "" : fmt::format(" ({})", missed_by(from, to));
  const Summary& ratio = *step.ratio;
  if (ratio.count < kFewestSamples) return fmt::format(" (sampled fewer than {} times)", kFewestSamples);
  return fmt::format(" ({}: × {:g} [{:g}, {:g}])",
                     relation(ratio, true) == Relation::kTied ? "a tie" : "undecided", ratio.median,
                     ratio.low, ratio.high);
}

// A remark for the reader if the 95 % interval leaves uncertain what the median decided.
std::string_view doubt(const Summary& s, double low, double high, bool holds) {
  if (holds) {
    return s.low < low || s.high > high ? "; uncertain: the 95 % interval reaches outside" : "";
  }
  if (s.low <= high && s.high >= low) return "; uncertain: the 95 % interval reaches in";
  return s.high - s.low > high - low ? "; uncertain: the 95 % interval is wider than the range" : "";
}

}  // namespace

Quantity quantity(const Operand& operand, const Metric& metric, bool name_case) {
  const std::string name = spoken(operand.metric);
  return {metric.samples,   name_case ? operand.case_name + " " + name : name, metric.unit, timed(metric),
          order_of(metric), operand.experiment + "/" + operand.case_name};
}

bool names_cases(const Claim& claim) {
  const Operand* first = nullptr;
  for (const Condition& condition : claim.conditions) {
    for (const Operand& operand : condition.operands) {
      if (operand.is_number()) continue;
      if (first == nullptr) first = &operand;
      if (operand.case_name != first->case_name) return true;
    }
  }
  return false;
}

ConditionResult word_missing(const Operand& o, bool name_case, const std::optional<WhyAbsent>& why) {
  return {ConditionResult::Outcome::kMissing,
          fmt::format("no {} of {} {} was measured{}", o.metric, o.experiment, o.case_name,
                      why ? fmt::format(" ({}: {})", why->word, why->reason) : ""),
          why ? std::string(why->word) : "not measured", "",
          (name_case ? o.case_name + " " : "") + spoken(o.metric)};
}

ConditionResult word_range(const Condition& condition, const std::vector<Quantity>& quantities,
                           const Summary& s, bool holds) {
  const Quantity &first = quantities[0], &second = quantities.back();
  ConditionResult found{outcome(holds), "", "", "", first.name};
  std::string what = first.name;
  std::string_view unit = first.unit;
  if (condition.kind == Condition::Kind::kRatio) {
    what = fmt::format("{} ÷ {}", first.name, second.name);
    found.quantity = what;
    unit = "";
  } else if (condition.kind == Condition::Kind::kGrowth) {
    what = fmt::format("{} grows by the factor", second.name);
    found.quantity = "growth of " + second.name;
    unit = "";
  }
  const bool timed = first.timed || second.timed;
  const double low = condition.low, high = condition.high;
  found.value = format_quantity(printed(s.median, timed), unit);
  found.expected = fmt::format("[{}, {}]", format_exact(low), format_exact(high));
  found.text = what + " " + found.value;
  if (s.low != s.high) {
    found.text +=
        fmt::format(" [{}, {}]", format_number(printed(s.low, timed)), format_number(printed(s.high, timed)));
  }
  found.text += fmt::format(", {} {}", holds ? "in" : "not in", found.expected);
  if (!holds) found.text += " but " + missed_by(s.median, s.median < low ? low : high);
  found.text += doubt(s, low, high, holds);
  return found;
}

ConditionResult word_chain(bool equal, const std::vector<Quantity>& quantities,
                           const std::vector<double>& medians, const std::vector<ChainStep>& steps,
                           std::size_t nearest) {
  const std::string_view sign = equal ? "=" : "<", broken = equal ? "≠" : "≥";
  const auto failing = std::ranges::find(steps, false, &ChainStep::holds);
  ConditionResult found{outcome(failing == steps.end()), show(quantities[0], medians[0]), "", "", ""};
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const bool in_order = equal ? steps[i].holds : medians[i] < medians[i + 1];
    found.text += fmt::format(" {} {}", in_order ? sign : broken, show(quantities[i + 1], medians[i + 1]));
    if (!steps[i].holds) found.text += why_not(steps[i], medians[i], medians[i + 1], in_order);
  }
  const std::size_t shown = failing == steps.end() ? nearest : failing - steps.begin();
  // Of the pair, a plain number is the bound; without one, the second operand is.
  const bool bound_first = quantities[shown].name.empty();
  const std::size_t bound = bound_first ? shown : shown + 1, measured = bound_first ? shown + 1 : shown;
  const auto value = [&](std::size_t k) {
    return format_quantity(printed(medians[k], quantities[k].timed), quantities[k].unit);
  };
  found.value = value(measured);
  found.expected = fmt::format("{} {}", bound_first && !equal ? ">" : sign, value(bound));
  found.quantity = quantities[measured].name;
  return found;
}

}  // namespace terrabench
