#include "results/check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "results/format.h"
#include "results/glob.h"
#include "results/statistics.h"
#include "terrain/error.h"
#include "terrain/image.h"

namespace terrabench {
namespace {

struct Finding {
  enum class Outcome { kHolds, kFails, kMissing } outcome;
  std::string text;
};

Finding finding(bool holds, std::string text) {
  return {holds ? Finding::Outcome::kHolds : Finding::Outcome::kFails, std::move(text)};
}

// The samples of an operand, with a name to show.
struct Quantity {
  std::vector<double> samples;
  std::string name, unit;
};

// Reads one claim from one profile's records, noting what it rests on.
class Reader {
 public:
  Reader(const Store& store, const std::string& profile, const Claim& claim)
      : store_(store), profile_(profile) {
    // Quantities of one case need only their names; of several, the case too.
    const Operand* first = nullptr;
    for (const Condition& condition : claim.conditions) {
      for (const Operand& operand : condition.operands) {
        if (operand.is_number()) continue;
        if (first == nullptr) first = &operand;
        name_cases_ = name_cases_ || operand.case_name != first->case_name;
      }
    }
  }

  Finding read(const Condition& condition) {
    if (condition.kind == Condition::Kind::kFigure) return read_figure(condition.figure);
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
        return {Finding::Outcome::kMissing, fmt::format("no {} of {} {} was measured", operand.metric,
                                                        operand.experiment, operand.case_name)};
      }
      rest_on(*record);
      records.push_back(record);
      std::string spoken = metric->name;
      std::replace(spoken.begin(), spoken.end(), '_', ' ');
      if (name_cases_) spoken = operand.case_name + " " + spoken;
      quantities.push_back({metric->samples, std::move(spoken), metric->unit});
    }
    if (sets_times_against_each_other(condition, quantities)) demand_comparable(records);
    return compare(condition, quantities);
  }

  const std::vector<std::string>& runs() const { return runs_; }
  bool altered() const { return altered_; }
  bool incomparable() const { return incomparable_; }

 private:
  void rest_on(const Record& record) {
    if (std::find(runs_.begin(), runs_.end(), record.run) == runs_.end()) runs_.push_back(record.run);
    altered_ = altered_ || store_.altered(record);
  }

  // A ratio is only as good as the likeness of the conditions that its two sides were measured under.
  static bool sets_times_against_each_other(const Condition& condition,
                                            const std::vector<Quantity>& quantities) {
    using Kind = Condition::Kind;
    if (condition.kind == Kind::kRatio || condition.kind == Kind::kGrowth) return true;
    return condition.kind == Kind::kOrder && std::any_of(quantities.begin(), quantities.end(),
                                                         [](const Quantity& q) { return is_timing(q.unit); });
  }

  void demand_comparable(const std::vector<const Record*>& records) {
    const Provenance* first = nullptr;
    for (const Record* const record : records) {
      const Provenance* const run = store_.run(record->run);
      if (run == nullptr) continue;  // a fault of the store already
      if (first == nullptr) first = run;
      incomparable_ = incomparable_ || !comparable(*first, *run);
    }
  }

  Finding read_figure(const std::string& id) {
    const auto [record, figure] = store_.find_figure(id, profile_);
    if (figure == nullptr) return {Finding::Outcome::kMissing, "no picture was drawn"};
    rest_on(*record);
    return look_at(*figure);
  }

  Finding look_at(const Figure& figure) const {
    const std::string& name = figure.file;
    try {
      const Image image = read_png(store_.folder() / name);
      if (!store_.intact(figure)) return finding(false, name + " is not the picture that was drawn");
      for (std::size_t i = 3; i < image.rgb.size(); ++i) {
        if (image.rgb[i] != image.rgb[i - 3]) {
          return finding(true, fmt::format("drawn, {} × {} pixels", image.width, image.height));
        }
      }
      return finding(false, name + " is blank");
    } catch (const Error& error) {
      return finding(false, fmt::format("the picture cannot be used: {}", error.what()));
    }
  }

  static Finding compare(const Condition&, const std::vector<Quantity>&);

  const Store& store_;
  const std::string& profile_;
  std::vector<std::string> runs_;
  bool altered_ = false, incomparable_ = false, name_cases_ = false;
};

std::string show(const Quantity& quantity, double value) {
  const std::string text = format_quantity(value, quantity.unit);
  return quantity.name.empty() ? text : quantity.name + " " + text;
}

// How far a value misses a bound, relative to the bound where that has a meaning.
std::string missed_by(double value, double bound) {
  const double distance = value - bound;
  if (!std::isfinite(distance)) return "without measure";
  const std::string_view side = distance < 0 ? "below" : "above";
  return bound == 0 ? fmt::format("{:.3g} {}", std::abs(distance), side)
                    : fmt::format("{:.3g} % {}", 100 * std::abs(distance / bound), side);
}

// The median alone decides. What its 95 % interval leaves open is said beside it.
std::string_view doubt(const Summary& s, double low, double high) {
  const bool holds = s.median >= low && s.median <= high;
  if (holds) {
    return s.low < low || s.high > high ? "; uncertain: the 95 % interval reaches outside" : "";
  }
  if (s.low <= high && s.high >= low) return "; uncertain: the 95 % interval reaches in";
  return s.high - s.low > high - low ? "; uncertain: the 95 % interval is wider than the range" : "";
}

Finding judge_range(const Condition& condition, const Summary& s, const std::string& what,
                    std::string_view unit) {
  std::string text = what + " " + format_quantity(s.median, unit);
  if (s.low != s.high) text += fmt::format(" [{}, {}]", format_number(s.low), format_number(s.high));
  const bool holds = s.median >= condition.low && s.median <= condition.high;
  text += fmt::format(", {} [{}, {}]", holds ? "in" : "not in", format_exact(condition.low),
                      format_exact(condition.high));
  if (!holds) {
    text += " but " + missed_by(s.median, s.median < condition.low ? condition.low : condition.high);
  }
  text += doubt(s, condition.low, condition.high);
  return finding(holds, text);
}

Finding Reader::compare(const Condition& condition, const std::vector<Quantity>& quantities) {
  using Kind = Condition::Kind;
  std::vector<double> medians;
  for (const Quantity& quantity : quantities) medians.push_back(summarise(quantity.samples).median);
  std::string chain = show(quantities[0], medians[0]);
  const auto judge_chain = [&](std::string_view sign, std::string_view broken, auto holds) {
    bool all = true;
    for (std::size_t i = 1; i < medians.size(); ++i) {
      const bool link = holds(medians[i - 1], medians[i]);
      chain += fmt::format(" {} {}", link ? sign : broken, show(quantities[i], medians[i]));
      if (!link && medians[i - 1] != medians[i]) {
        chain += fmt::format(" ({})", missed_by(medians[i - 1], medians[i]));
      }
      all = all && link;
    }
    return finding(all, chain);
  };
  switch (condition.kind) {
    case Kind::kEqual:
      return judge_chain("=", "≠", [](double a, double b) { return a == b; });
    case Kind::kOrder:
      return judge_chain("<", "≥", [](double a, double b) { return a < b; });
    case Kind::kWithin:
      return judge_range(condition, summarise(quantities[0].samples), quantities[0].name, quantities[0].unit);
    case Kind::kRatio:
      return judge_range(condition, summarise_ratio(quantities[0].samples, quantities[1].samples),
                         fmt::format("{} ÷ {}", quantities[0].name, quantities[1].name), "");
    case Kind::kGrowth:
      return judge_range(condition, summarise_ratio(quantities[1].samples, quantities[0].samples),
                         fmt::format("{} grows by the factor", quantities[1].name), "");
    case Kind::kFigure:
      break;
  }
  return finding(false, "");
}

// The row's findings, each text once.
std::string joined(const std::vector<Finding>& findings) {
  std::string text;
  for (const Finding& f : findings) {
    if (!text.empty()) text += "; ";
    text += f.text;
  }
  return text;
}

void judge(Row& row, const Store& store, const std::string& profile) {
  const Claim& claim = *row.claim;
  Reader reader(store, profile, claim);
  std::vector<Finding> findings;
  for (const Condition& condition : claim.conditions) findings.push_back(reader.read(condition));
  row.runs = reader.runs();
  const auto any = [&](Finding::Outcome outcome) {
    return std::any_of(findings.begin(), findings.end(),
                       [&](const Finding& f) { return f.outcome == outcome; });
  };
  if (any(Finding::Outcome::kMissing)) {
    std::erase_if(findings, [](const Finding& f) { return f.outcome != Finding::Outcome::kMissing; });
    row.verdict = Verdict::kMissing;
  } else if (any(Finding::Outcome::kFails)) {
    row.verdict = Verdict::kDiffers;
  } else {
    row.verdict = claim.type == 'S' ? Verdict::kShape : Verdict::kReproduced;
  }
  row.measured = joined(findings);
  if (reader.altered()) {
    row.complaint = "rests on a record that was altered";
  } else if (reader.incomparable()) {
    row.complaint = "compares what was measured on different machines or builds";
  } else if (row.verdict != claim.known) {
    row.complaint = fmt::format("known as '{}', found '{}'", name(claim.known), name(row.verdict));
  }
}

bool chosen(const Claim& claim, std::span<const std::string> globs) {
  return globs.empty() || std::any_of(globs.begin(), globs.end(),
                                      [&](const std::string& glob) { return matches_glob(glob, claim.id); });
}

// A misspelt glob must not pass for a ledger without complaints.
void demand_matches(std::span<const Paper> papers, std::span<const std::string> globs) {
  std::vector<std::string_view> ids;
  for (const Paper& paper : papers) {
    for (const Claim& claim : paper.claims) ids.push_back(claim.id);
  }
  for (const std::string& glob : globs) {
    if (std::none_of(ids.begin(), ids.end(), [&](std::string_view id) { return matches_glob(glob, id); })) {
      throw unknown_name("row", glob, ids);
    }
  }
}

void look_for_altered_pictures(const Store& store, CheckReport& report) {
  for (const Record& record : store.records()) {
    if (record.profile != report.profile) continue;
    for (const Figure& figure : record.figures) {
      if (store.intact(figure)) continue;
      report.faults.push_back(fmt::format("{}: picture altered or gone: not the one that {} {} drew",
                                          (store.folder() / figure.file).string(), record.experiment,
                                          record.case_name));
      report.warnings.push_back(report.faults.back());
    }
  }
}

}  // namespace

bool CheckReport::passed() const {
  return faults.empty() &&
         std::all_of(rows.begin(), rows.end(), [](const Row& row) { return row.complaint.empty(); });
}

CheckReport check(const std::filesystem::path& folder, std::span<const std::string> row_globs) {
  return check(Store::open(folder), papers(), row_globs);
}

CheckReport check(const Store& store, std::span<const Paper> papers, std::span<const std::string> row_globs) {
  demand_matches(papers, row_globs);
  CheckReport report;
  report.profile = store.last_profile();
  report.warnings = store.warnings();
  report.faults = store.faults();
  look_for_altered_pictures(store, report);
  for (const Paper& paper : papers) {
    for (const Claim& claim : paper.claims) {
      if (!chosen(claim, row_globs)) continue;
      Row row{&paper, &claim, Verdict::kPending, claim.pending, {}, ""};
      if (!claim.not_comparable.empty()) {
        row.verdict = Verdict::kNotComparable;
        row.measured = claim.not_comparable;
      } else if (claim.pending.empty()) {
        const auto& profiles = claim.profiles;
        if (std::find(profiles.begin(), profiles.end(), report.profile) != profiles.end()) {
          judge(row, store, report.profile);
        } else {
          row.verdict = Verdict::kNotRun;
          row.measured = fmt::format("measured in profile {}", fmt::join(profiles, ", "));
        }
      }
      report.rows.push_back(std::move(row));
    }
  }
  return report;
}

}  // namespace terrabench
