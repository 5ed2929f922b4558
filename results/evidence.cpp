#include "results/evidence.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "results/format.h"
#include "results/statistics.h"
#include "terrain/error.h"
#include "terrain/image.h"

namespace terrabench {
namespace {

using Kind = Condition::Kind;
using Outcome = Finding::Outcome;

// An operand with its samples. A number has no name.
struct Quantity {
  std::vector<double> samples;
  std::string name, unit;
  std::string metric;  // the name without the case

  std::string show(double value) const {
    const std::string text = format_quantity(value, unit);
    return name.empty() ? text : name + " " + text;
  }
};

Outcome outcome(bool holds) { return holds ? Outcome::kHolds : Outcome::kFails; }

// How far a value misses a bound, relative to the bound unless that is 0.
std::string missed_by(double value, double bound) {
  const double distance = value - bound;
  if (!std::isfinite(distance)) return "at no finite distance";
  const std::string_view side = distance < 0 ? "below" : "above";
  return bound == 0 ? fmt::format("{:.3g} {}", std::abs(distance), side)
                    : fmt::format("{:.3g} % {}", 100 * std::abs(distance / bound), side);
}

// The median alone decides the outcome. Remark for the reader if the 95 % interval leaves it uncertain.
std::string_view doubt(const Summary& s, double low, double high) {
  const bool holds = s.median >= low && s.median <= high;
  if (holds) {
    return s.low < low || s.high > high ? "; uncertain: the 95 % interval reaches outside" : "";
  }
  if (s.low <= high && s.high >= low) return "; uncertain: the 95 % interval reaches in";
  return s.high - s.low > high - low ? "; uncertain: the 95 % interval is wider than the range" : "";
}

// within, ratio, growth.
Finding compare_range(const Condition& condition, const Summary& s, const std::string& what,
                      const std::string& metric, std::string_view unit) {
  const bool holds = s.median >= condition.low && s.median <= condition.high;
  Finding found{outcome(holds), "", format_quantity(s.median, unit),
                fmt::format("[{}, {}]", format_exact(condition.low), format_exact(condition.high)), metric};
  found.text = what + " " + found.value;
  if (s.low != s.high) found.text += fmt::format(" [{}, {}]", format_number(s.low), format_number(s.high));
  found.text += fmt::format(", {} {}", holds ? "in" : "not in", found.expected);
  if (!holds) {
    found.text += " but " + missed_by(s.median, s.median < condition.low ? condition.low : condition.high);
  }
  found.text += doubt(s, condition.low, condition.high);
  return found;
}

// equal, order. The finding shows the first neighbouring pair that fails; if all hold, the first pair.
Finding compare_chain(bool equal, const std::vector<Quantity>& quantities) {
  const std::string_view sign = equal ? "=" : "<", broken = equal ? "≠" : "≥";
  double before = summarise(quantities[0].samples).median;
  Finding found{Outcome::kHolds, quantities[0].show(before), "", "", ""};
  for (std::size_t i = 1; i < quantities.size(); ++i) {
    const double median = summarise(quantities[i].samples).median;
    const bool holds = equal ? before == median : before < median;
    found.text += fmt::format(" {} {}", holds ? sign : broken, quantities[i].show(median));
    if (!holds && before != median) found.text += fmt::format(" ({})", missed_by(before, median));
    if (i == 1 || (!holds && found.outcome == Outcome::kHolds)) {
      // Of the pair, a plain number is the bound; without one, the second operand is.
      const bool bound_first = quantities[i - 1].name.empty();
      const Quantity &bound = quantities[bound_first ? i - 1 : i],
                     &measured = quantities[bound_first ? i : i - 1];
      found.value = format_quantity(bound_first ? median : before, measured.unit);
      found.expected = fmt::format("{} {}", bound_first && !equal ? ">" : sign,
                                   format_quantity(bound_first ? before : median, bound.unit));
      found.quantity = measured.metric;
    }
    if (!holds) found.outcome = Outcome::kFails;
    before = median;
  }
  return found;
}

Finding compare(const Condition& condition, const std::vector<Quantity>& quantities) {
  const Quantity &first = quantities[0], &second = quantities.back();
  switch (condition.kind) {
    case Kind::kWithin:
      return compare_range(condition, summarise(first.samples), first.name, first.metric, first.unit);
    case Kind::kRatio:
      return compare_range(condition, summarise_ratio(first.samples, second.samples),
                           fmt::format("{} ÷ {}", first.name, second.name),
                           fmt::format("{} ÷ {}", first.metric, second.metric), "");
    case Kind::kGrowth:
      return compare_range(condition, summarise_ratio(second.samples, first.samples),
                           fmt::format("{} grows by the factor", second.name), "growth of " + second.metric,
                           "");
    default:
      return compare_chain(condition.kind == Kind::kEqual, quantities);
  }
}

// Whether the records must come from one machine and build: for ratios, growth, and orders of times.
bool needs_one_machine(const Condition& condition, const std::vector<Quantity>& quantities) {
  if (condition.kind == Kind::kRatio || condition.kind == Kind::kGrowth) return true;
  return condition.kind == Kind::kOrder && std::any_of(quantities.begin(), quantities.end(),
                                                       [](const Quantity& q) { return is_timing(q.unit); });
}

// The mean of all pixels' channels, 0 black to 1 white.
double brightness(const Image& image) {
  double sum = 0;
  for (const std::uint8_t channel : image.rgb) sum += channel;
  return sum / (255.0 * static_cast<double>(image.rgb.size()));
}

// Evaluates the conditions of one claim and notes which records they read.
class Reader {
 public:
  Reader(const Store& store, const std::string& profile, const Mutate& mutate)
      : store_(store), profile_(profile), mutate_(mutate) {}

  Evidence read(const Claim& claim) {
    // Operands that all read one case are shown without its name.
    const Operand* first = nullptr;
    for (const Condition& condition : claim.conditions) {
      for (const Operand& operand : condition.operands) {
        if (operand.is_number() || condition.kind == Kind::kFigure) continue;
        if (first == nullptr) first = &operand;
        name_cases_ = name_cases_ || operand.case_name != first->case_name;
      }
    }
    for (const Condition& condition : claim.conditions) {
      evidence_.findings.push_back(condition.kind == Kind::kFigure ? read_figure(condition)
                                                                   : read_metrics(condition));
    }
    return std::move(evidence_);
  }

 private:
  Finding read_metrics(const Condition& condition) {
    std::vector<Quantity> quantities;
    std::vector<const Record*> records;
    for (const Operand& operand : condition.operands) {
      if (operand.is_number()) {
        quantities.push_back({{operand.number}, "", "", ""});
        continue;
      }
      const Record* const record = store_.find(operand.experiment, operand.case_name, profile_);
      const Metric* const metric = record == nullptr ? nullptr : record->find(operand.metric);
      std::string spoken = operand.metric;
      std::replace(spoken.begin(), spoken.end(), '_', ' ');
      if (metric == nullptr) {
        return {
            Outcome::kMissing,
            fmt::format("no {} of {} {} was measured", operand.metric, operand.experiment, operand.case_name),
            "not measured", "", spoken};
      }
      note_read(*record);
      records.push_back(record);
      const std::string name = name_cases_ ? operand.case_name + " " + spoken : spoken;
      quantities.push_back({metric->samples, name, metric->unit, std::move(spoken)});
    }
    if (needs_one_machine(condition, quantities)) note_incomparable(records);
    if (mutate_) mutate(quantities);
    return compare(condition, quantities);
  }

  void mutate(std::vector<Quantity>& quantities) const {
    std::vector<std::vector<double>> samples;
    for (const Quantity& q : quantities) {
      if (!q.name.empty()) samples.push_back(q.samples);
    }
    mutate_(samples);
    auto next = samples.begin();
    for (Quantity& q : quantities) {
      if (!q.name.empty()) q.samples = std::move(*next++);
    }
  }

  Finding read_figure(const Condition& condition) {
    const auto [record, figure] = store_.find_figure(condition.figure, profile_);
    if (figure == nullptr) return {Outcome::kMissing, "no picture was drawn", "not drawn", "", "picture"};
    note_read(*record);
    const auto [holds, text] = inspect(condition, *figure);
    return {outcome(holds), text, holds ? "drawn" : "not usable", "", "picture"};
  }

  // Whether the picture is the one that was drawn, shows something, and contains what it should.
  std::pair<bool, std::string> inspect(const Condition& condition, const RecordedFigure& figure) const {
    const std::string& name = figure.file;
    try {
      const Image image = read_png(store_.folder() / name);
      if (!store_.intact(figure)) return {false, name + " is not the picture that was drawn"};
      const FigureLayout whole{{{0, 0, image.width, image.height}}, {}};
      if (!layout_fault(whole, image).empty()) return {false, name + " is blank"};
      std::string text = fmt::format("drawn, {} × {} pixels", image.width, image.height);
      if (!figure.layout) return {true, text + ", layout not recorded"};
      const std::string fault = content_fault(condition, *figure.layout, image);
      if (!fault.empty()) return {false, fmt::format("{}: {}", name, fault)};
      if (condition.panels > 0) text += fmt::format(", panels: {}", condition.panels);
      if (!condition.operands.empty())
        text += fmt::format(", metrics printed: {}", condition.operands.size());
      if (!condition.brightness.empty()) text += ", brightness as measured";
      return {true, text};
    } catch (const Error& error) {
      return {false, fmt::format("the picture cannot be used: {}", error.what())};
    }
  }

  // What the picture contains that it should not, or lacks; empty if nothing.
  std::string content_fault(const Condition& condition, const FigureLayout& layout,
                            const Image& image) const {
    const std::size_t expected = static_cast<std::size_t>(condition.panels);
    if (expected > 0 && layout.panels.size() != expected) {
      return fmt::format("has {} panels, not {}", layout.panels.size(), expected);
    }
    // Small panels, such as those of a tree's nodes, may be of one colour or look the same: only declared
    // panels must not.
    std::string fault = expected > 0 ? layout_fault(layout, image) : "";
    for (const Operand& operand : condition.operands) {
      const std::optional<double> value = metric_of(operand);
      if (fault.empty() && (!value || !says(layout, *value))) {
        fault =
            fmt::format("does not print {} of {} {}", operand.metric, operand.experiment, operand.case_name);
      }
    }
    for (const Operand& operand : condition.brightness) {
      const std::optional<double> value = metric_of(operand);
      const double seen = brightness(image);
      if (fault.empty() && (!value || std::abs(seen - *value) > Condition::kBrightness)) {
        fault = fmt::format("its brightness is {:.3f}, not {} of {} {}", seen, operand.metric,
                            operand.experiment, operand.case_name);
      }
    }
    return fault;
  }

  std::optional<double> metric_of(const Operand& operand) const {
    const Record* const record = store_.find(operand.experiment, operand.case_name, profile_);
    const Metric* const metric = record == nullptr ? nullptr : record->find(operand.metric);
    if (metric == nullptr) return std::nullopt;
    return median(metric->samples);
  }

  void note_read(const Record& record) {
    std::vector<std::string>& runs = evidence_.runs;
    if (std::ranges::count(runs, record.run) == 0) runs.push_back(record.run);
    evidence_.altered = evidence_.altered || store_.altered(record);
  }

  void note_incomparable(const std::vector<const Record*>& records) {
    const Provenance* first = nullptr;
    for (const Record* const record : records) {
      const Provenance* const run = store_.run(record->run);
      if (run == nullptr) continue;  // the store reports this as a fault
      if (first == nullptr) first = run;
      evidence_.incomparable = evidence_.incomparable || !comparable(*first, *run);
    }
  }

  const Store& store_;
  const std::string& profile_;
  const Mutate& mutate_;
  bool name_cases_ = false;
  Evidence evidence_;
};

}  // namespace

Evidence gather_evidence(const Claim& claim, const Store& store, const std::string& profile,
                         const Mutate& mutate) {
  return Reader(store, profile, mutate).read(claim);
}

}  // namespace terrabench
