#include "results/store/absences.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>

namespace terrabench {
namespace {

// Collects by outcome and reason.
class Groups {
 public:
  void add(std::string_view what, const std::string& reason, std::string where) {
    const auto [at, added] = places_.try_emplace({std::string(what), reason}, groups_.size());
    if (added) groups_.push_back({std::string(what), reason, {}});
    groups_[at->second].where.push_back(std::move(where));
  }
  std::vector<Absence> take() { return std::move(groups_); }

 private:
  std::vector<Absence> groups_;
  std::map<std::pair<std::string, std::string>, std::size_t> places_;
};

std::string title(const Record& record) { return record.experiment + " " + record.case_name; }

}  // namespace

std::vector<Absence> absences(std::span<const Record* const> records) {
  Groups groups;
  for (const CaseOutcome outcome : {CaseOutcome::kFailed, CaseOutcome::kSkipped}) {
    for (const Record* const record : records) {
      if (record->outcome == outcome) groups.add(name(outcome), record->reason, title(*record));
    }
  }
  for (const Record* const record : records) {
    std::map<std::string, std::vector<std::string>> metrics;  // by reason
    for (const auto& [metric, reason] : record->undefined) metrics[reason].push_back(metric);
    for (const auto& [reason, of] : metrics) {
      groups.add("not defined", reason, fmt::format("{}: {}", title(*record), fmt::join(of, ", ")));
    }
  }
  return groups.take();
}

std::string absences_text(std::span<const Absence> all_absences, bool all) {
  constexpr std::size_t kShown = 5;
  std::string text;
  for (const Absence& absence : all_absences) {
    const std::size_t count = absence.where.size(), shown = all ? count : std::min(count, kShown);
    text += fmt::format("{} ({} case{}): {}\n", absence.what, count, count == 1 ? "" : "s", absence.reason);
    for (std::size_t i = 0; i < shown; ++i) text += fmt::format("  {}\n", absence.where[i]);
    if (count > shown) text += fmt::format("  and {} more\n", count - shown);
  }
  return text;
}

}  // namespace terrabench
