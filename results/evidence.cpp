// To follow one condition, read from the end: Reader::read(), read_metrics() (operands to samples), compare()
// (kind to median or ratio, and whether it holds). How findings are worded can wait: findings_text.cpp.
#include "results/evidence.h"

#include <fmt/format.h>

#include <algorithm>

#include "results/findings_text.h"
#include "terrain/error.h"
#include "terrain/image.h"

namespace terrabench {
namespace {

using Kind = Condition::Kind;
using Outcome = Finding::Outcome;

// Decides whether the condition holds; word_range() and word_chain() make a finding of that. Medians decide.
Finding compare(const Condition& condition, const std::vector<Quantity>& quantities) {
  const std::vector<double>&first = quantities[0].samples, &second = quantities.back().samples;
  const auto in_range = [&](const Summary& s) {
    return word_range(condition, quantities, s, s.median >= condition.low && s.median <= condition.high);
  };
  if (condition.kind == Kind::kWithin) return in_range(summarise(first));
  if (condition.kind == Kind::kRatio) return in_range(summarise_ratio(first, second));
  if (condition.kind == Kind::kGrowth) return in_range(summarise_ratio(second, first));
  const bool equal = condition.kind == Kind::kEqual;  // else order: read() keeps figures apart
  std::vector<double> medians;
  std::vector<bool> holds;  // for each median but the first: with the one before it
  for (const Quantity& q : quantities) {
    const double median = summarise(q.samples).median;
    if (!medians.empty()) holds.push_back(equal ? medians.back() == median : medians.back() < median);
    medians.push_back(median);
  }
  return word_chain(equal, quantities, medians, holds);
}

// Whether the records must come from one machine and build: for ratios, growth, and orders of times.
bool needs_one_machine(const Condition& condition, const std::vector<Quantity>& quantities) {
  if (condition.kind == Kind::kRatio || condition.kind == Kind::kGrowth) return true;
  return condition.kind == Kind::kOrder && std::any_of(quantities.begin(), quantities.end(),
                                                       [](const Quantity& q) { return is_timing(q.unit); });
}

// Evaluates the conditions of one claim and notes which records they read.
class Reader {
 public:
  Reader(const Store& store, const std::string& profile) : store_(store), profile_(profile) {}

  Evidence read(const Claim& claim) {
    name_cases_ = names_cases(claim);
    for (const Condition& condition : claim.conditions) {
      evidence_.findings.push_back(condition.kind == Kind::kFigure ? read_figure(condition.figure)
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
      if (metric == nullptr) return word_missing(operand);
      note_read(*record);
      records.push_back(record);
      quantities.push_back(quantity(operand, *metric, name_cases_));
    }
    if (needs_one_machine(condition, quantities)) note_incomparable(records);
    return compare(condition, quantities);
  }

  Finding read_figure(const std::string& id) {
    const auto [record, figure] = store_.find_figure(id, profile_);
    if (figure == nullptr) return {Outcome::kMissing, "no picture was drawn", "not drawn", "", "picture"};
    note_read(*record);
    const auto [holds, text] = inspect(*figure);
    return {outcome(holds), text, holds ? "drawn" : "not usable", "", "picture"};
  }

  // Whether the picture is the one that was drawn and shows something.
  std::pair<bool, std::string> inspect(const RecordedFigure& figure) const {
    const std::string& name = figure.file;
    try {
      const Image image = read_png(store_.folder() / name);
      if (!store_.intact(figure)) return {false, name + " is not the picture that was drawn"};
      for (std::size_t i = 3; i < image.rgb.size(); ++i) {
        if (image.rgb[i] != image.rgb[i - 3]) {
          return {true, fmt::format("drawn, {} × {} pixels", image.width, image.height)};
        }
      }
      return {false, name + " is blank"};
    } catch (const Error& error) {
      return {false, fmt::format("the picture cannot be used: {}", error.what())};
    }
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
  bool name_cases_ = false;
  Evidence evidence_;
};

}  // namespace

Evidence gather_evidence(const Claim& claim, const Store& store, const std::string& profile) {
  return Reader(store, profile).read(claim);
}

}  // namespace terrabench
