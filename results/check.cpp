#include "results/check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "results/format.h"
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
      std::string spoken = metric->name;
      std::replace(spoken.begin(), spoken.end(), '_', ' ');
      if (name_cases_) spoken = operand.case_name + " " + spoken;
      quantities.push_back({metric->samples, std::move(spoken), metric->unit});
    }
    return compare(condition, quantities);
  }

  const std::vector<std::string>& runs() const { return runs_; }
  bool altered() const { return altered_; }

 private:
  void rest_on(const Record& record) {
    if (std::find(runs_.begin(), runs_.end(), record.run) == runs_.end()) runs_.push_back(record.run);
    altered_ = altered_ || store_.altered(record);
  }

  Finding read_figure(const std::string& id) {
    for (const Record& record : store_.records()) {
      if (record.profile != profile_) continue;
      const auto it = std::find_if(record.figures.begin(), record.figures.end(),
                                   [&](const Figure& figure) { return figure.id == id; });
      if (it == record.figures.end()) continue;
      rest_on(record);
      return look_at(store_.folder() / it->file, it->file);
    }
    return {Finding::Outcome::kMissing, "no picture was drawn"};
  }

  static Finding look_at(const std::filesystem::path& path, const std::string& name) {
    try {
      const Image image = read_png(path);
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
  bool altered_ = false, name_cases_ = false;
};

std::string show(const Quantity& quantity, double value) {
  const std::string text = format_quantity(value, quantity.unit);
  return quantity.name.empty() ? text : quantity.name + " " + text;
}

// A timing is a sample of what the machine does: it counts as inside when its median is, or when its 95 %
// interval reaches in, unless that interval is so wide that it says nothing.
bool inside(const Summary& s, double low, double high) {
  if (s.median >= low && s.median <= high) return true;
  return s.low <= high && s.high >= low && s.high - s.low <= high - low;
}

Finding judge_range(const Condition& condition, const Summary& s, const std::string& what,
                    std::string_view unit) {
  std::string text = what + " " + format_quantity(s.median, unit);
  if (s.low != s.high) text += fmt::format(" [{}, {}]", format_number(s.low), format_number(s.high));
  const bool holds = inside(s, condition.low, condition.high);
  text += fmt::format(", {} [{}, {}]", holds ? "in" : "not in", format_number(condition.low),
                      format_number(condition.high));
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
  } else if (row.verdict != claim.known) {
    row.complaint = fmt::format("known as '{}', found '{}'", name(claim.known), name(row.verdict));
  }
}

}  // namespace

bool CheckReport::passed() const {
  return faults.empty() &&
         std::all_of(rows.begin(), rows.end(), [](const Row& row) { return row.complaint.empty(); });
}

CheckReport check(const std::filesystem::path& folder) { return check(Store::open(folder), papers()); }

CheckReport check(const Store& store, std::span<const Paper> papers) {
  CheckReport report;
  report.profile = store.last_profile();
  report.warnings = store.warnings();
  report.faults = store.faults();
  for (const Paper& paper : papers) {
    for (const Claim& claim : paper.claims) {
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
