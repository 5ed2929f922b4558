// To follow one condition, read from the end: Reader::read(), read_metrics() (operands to samples), compare()
// (kind to median or ratio, and whether it holds). A Quantity is an operand's name, unit and samples. How
// results are worded can wait: condition_text.cpp.
#include "results/claims/evidence.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "results/claims/condition_text.h"
#include "results/store/provenance.h"
#include "terrain/error.h"
#include "terrain/image.h"

namespace terrabench {
namespace {

using Kind = Condition::Kind;
using Outcome = ConditionResult::Outcome;

// Relative difference of two values: |a - b| ÷ max(|a|, |b|), at most 1. 0 if they are equal, 1 if their
// signs differ.
double margin_between(double a, double b) {
  const double distance = std::abs(b - a), scale = std::max(std::abs(a), std::abs(b));
  if (distance == 0) return 0;
  return std::isfinite(scale) ? std::min(1.0, distance / scale) : 1;
}

// The smaller of the relative differences to the two bounds of the range in which the value lies. Some do not
// count: a lower bound of 0, since counts, bytes, times and shares are never less; and an upper bound of 1 of
// a condition `within` whose lower bound is above 0, since the value is a share, of which 1 is the best. None
// for a range of one value, as for an equality.
std::optional<double> margin_in_range(double value, const Condition& condition) {
  const double low = condition.low, high = condition.high;
  const bool share = condition.kind == Kind::kWithin && low > 0 && high == 1;
  if (low == high) return std::nullopt;
  return std::min(low != 0 ? margin_between(low, value) : 1.0, share ? 1.0 : margin_between(value, high));
}

Summary ratio_of(const Quantity& a, const Quantity& b) {
  const bool series = a.order == Order::kSeries && b.order == Order::kSeries;
  return summarise_ratio(a.samples, b.samples, series ? Order::kSeries : Order::kIndependent, a.of == b.of);
}

// Whether one is below the next. Two times or rates are compared by relation(), all else by the medians:
// shares and ratios of times that were taken in turn, too, from which the speed of the machine cancels out,
// and exponents, which are fitted to the times of several sizes and have no samples of their own.
ChainStep below(const Quantity& a, const Quantity& b, double median_a, double median_b) {
  const auto sampled = [](const Quantity& q) { return is_timing(q.unit) && q.unit != "exponent"; };
  if (!sampled(a) || !sampled(b)) return {median_a < median_b, std::nullopt};
  const Summary ratio = three_digits(ratio_of(b, a));
  return {relation(ratio, true) == Relation::kMore, ratio};
}

ConditionResult compare_chain(const Condition& condition, const std::vector<Quantity>& quantities) {
  const bool equal = condition.kind == Kind::kEqual;
  constexpr double kNoBound = std::numeric_limits<double>::infinity();
  std::vector<double> medians, margins;
  std::vector<ChainStep> steps;  // for each quantity but the first: with the one before it
  for (const Quantity& q : quantities) {
    const double here = median(q.samples);
    if (!medians.empty()) {
      const double before = medians.back();
      const Quantity& last = quantities[medians.size() - 1];
      const bool from_zero = last.name.empty() && before == 0;  // a bound that does not count
      steps.push_back(equal ? ChainStep{before == here, std::nullopt} : below(last, q, before, here));
      margins.push_back(equal ? 0 : from_zero ? kNoBound : margin_between(before, here));
    }
    medians.push_back(here);
  }
  const auto nearest = std::ranges::min_element(margins);
  ConditionResult found = word_chain(equal, quantities, medians, steps, nearest - margins.begin());
  if (!equal && found.outcome == Outcome::kHolds && *nearest < kNoBound) found.margin = *nearest;
  return found;
}

// Decides whether the condition holds; word_range() and word_chain() make a finding of that. Medians decide,
// except on the order of two times.
ConditionResult compare(const Condition& condition, const std::vector<Quantity>& quantities) {
  if (condition.kind == Kind::kEqual || condition.kind == Kind::kOrder)
    return compare_chain(condition, quantities);
  const Quantity &first = quantities[0], &second = quantities.back();
  const Summary s = condition.kind == Kind::kWithin  ? summarise(first.samples, first.order)
                    : condition.kind == Kind::kRatio ? ratio_of(first, second)
                                                     : ratio_of(second, first);
  const bool holds = s.median >= condition.low && s.median <= condition.high;
  ConditionResult found = word_range(condition, quantities, s, holds);
  if (holds) found.margin = margin_in_range(s.median, condition);
  return found;
}

// Whether records of two runs may meet in the condition. Ratios, growth and orders of what varies from run to
// run need one machine and build, other ratios and growth one revision.
bool may_meet(const Condition& condition, const std::vector<Quantity>& quantities, const Provenance& a,
              const Provenance& b) {
  const bool relates = condition.kind == Kind::kRatio || condition.kind == Kind::kGrowth;
  const bool timed = std::ranges::any_of(quantities, &Quantity::timed);
  if (timed && (relates || condition.kind == Kind::kOrder)) return comparable(a, b);
  return !relates || same_code(a, b);
}

FigureLayout whole_of(const Image& image) { return {{{0, 0, image.width, image.height}}, {}}; }

// The mean of all channels of the panels' pixels, 0 black to 1 white. The panels lie within the picture.
double brightness(const FigureLayout& layout, const Image& image) {
  double sum = 0, channels = 0;
  for (const FigurePanel& panel : layout.panels) {
    for (int y = panel.y; y < panel.y + panel.height; ++y) {
      for (int x = panel.x; x < panel.x + panel.width; ++x) {
        for (const std::uint8_t channel : image.pixel(x, y)) sum += channel;
      }
    }
    channels += 3.0 * panel.width * panel.height;
  }
  return sum / (255 * channels);
}

// Evaluates the conditions of one claim and notes which records they read.
class Reader {
 public:
  Reader(const Store& store, const std::string& profile, const Mutate& mutate)
      : store_(store), profile_(profile), mutate_(mutate) {}

  Evidence read(const Claim& claim) {
    name_cases_ = names_cases(claim);
    for (const Condition& condition : claim.conditions) {
      evidence_.results.push_back(condition.kind == Kind::kFigure ? read_figure(condition)
                                                                  : read_metrics(condition));
    }
    return std::move(evidence_);
  }

 private:
  ConditionResult read_metrics(const Condition& condition) {
    std::vector<Quantity> quantities;
    std::vector<const Record*> records;
    for (const Operand& operand : condition.operands) {
      if (operand.is_number()) {
        quantities.push_back({{operand.number}, "", ""});
        continue;
      }
      const Record* const record = store_.find(operand.experiment, operand.case_name, profile_);
      const Metric* const metric = record == nullptr ? nullptr : record->find(operand.metric);
      if (metric == nullptr) {
        return word_missing(operand, name_cases_,
                            record == nullptr ? std::nullopt : record->why_absent(operand.metric));
      }
      note_read(*record);
      records.push_back(record);
      quantities.push_back(quantity(operand, *metric, name_cases_));
    }
    note_incomparable(condition, quantities, records);
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

  ConditionResult read_figure(const Condition& condition) {
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
      const Image image = read_picture(store_.path_of(name));
      if (!store_.intact(figure)) return {false, name + " is not the picture that was drawn"};
      const FigureLayout whole = whole_of(image);
      if (!layout_fault(whole, image).empty()) return {false, name + " is blank"};
      std::string text = fmt::format("drawn, {} × {} pixels", image.width, image.height);
      const std::string fault = content_fault(condition, figure.layout, image);
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
    std::string fault = expected > 0 ? layout_fault(layout, image, condition.alike) : "";
    for (const Operand& operand : condition.operands) {
      const std::optional<double> value = metric_of(operand);
      if (fault.empty() && (!value || !says(layout, *value))) {
        fault =
            fmt::format("does not print {} of {} {}", operand.metric, operand.experiment, operand.case_name);
      }
    }
    for (const Operand& operand : condition.brightness) {
      const std::optional<double> value = metric_of(operand);
      if (!fault.empty()) break;
      const double seen = brightness(expected > 0 ? layout : whole_of(image), image);
      if (!value || std::abs(seen - *value) > Condition::kBrightness) {
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

  void note_incomparable(const Condition& condition, const std::vector<Quantity>& quantities,
                         const std::vector<const Record*>& records) {
    const Provenance* first = nullptr;
    for (const Record* const record : records) {
      const Provenance* const run = store_.run(record->run);
      if (run == nullptr) continue;  // the store reports this as a fault
      if (first == nullptr) first = run;
      evidence_.incomparable = evidence_.incomparable || !may_meet(condition, quantities, *first, *run);
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
