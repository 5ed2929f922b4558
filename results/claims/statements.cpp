#include "results/claims/statements.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <utility>

namespace terrabench {
namespace {

Standing standing_of(Statement& statement) {
  const Verdict verdict = statement.claim->verdict;
  if (holds(verdict)) return Standing::kAsPrinted;
  if (verdict != Verdict::kDiffers) return Standing::kNotJudged;
  const auto reading = std::ranges::find_if(statement.sub_rows, [](const Judgement* row) {
    return row->claim->varies == Variation::kReading && holds(row->verdict);
  });
  if (reading == statement.sub_rows.end()) return Standing::kDoesNotHold;
  statement.reading = *reading;
  return Standing::kOtherReading;
}

}  // namespace

std::string_view name(Standing standing, Group group) {
  constexpr std::string_view kNames[] = {"hold as printed", "hold in another reading", "do not hold",
                                         "not judged"};
  if (group == Group::kBeyond && standing == Standing::kAsPrinted) return "hold";
  return kNames[static_cast<std::size_t>(standing)];
}

std::vector<Statement> statements(std::span<const Judgement> judgements) {
  std::vector<Statement> all;
  std::map<std::pair<const Paper*, std::string_view>, std::size_t> by_id;
  for (const Judgement& j : judgements) {
    if (!j.claim->of.empty()) continue;
    by_id[{j.paper, j.claim->id}] = all.size();
    all.push_back({&j});
  }
  for (const Judgement& j : judgements) {
    if (j.claim->of.empty()) continue;
    const auto at = by_id.find({j.paper, j.claim->of});
    if (at != by_id.end()) all[at->second].sub_rows.push_back(&j);
  }
  for (Statement& statement : all) {
    statement.standing = standing_of(statement);
    statement.everywhere = std::ranges::none_of(statement.sub_rows, [](const Judgement* row) {
      return row->claim->varies != Variation::kReading && row->verdict == Verdict::kDiffers;
    });
  }
  return all;
}

std::map<Group, StandingCounts> count_standings(std::span<const Statement> all) {
  std::map<Group, StandingCounts> counts;
  for (const Statement& s : all) ++counts[s.claim->claim->group][static_cast<std::size_t>(s.standing)];
  return counts;
}

int count_everywhere(std::span<const Statement> all, Group group) {
  return static_cast<int>(std::ranges::count_if(all, [&](const Statement& s) {
    return s.claim->claim->group == group && s.standing == Standing::kAsPrinted && s.everywhere;
  }));
}

int sum(const StandingCounts& counts) { return std::accumulate(counts.begin(), counts.end(), 0); }

std::string counts_text(const StandingCounts& counts, Group group) {
  std::string text;
  for (const Standing standing : kStandings) {
    const int count = counts[static_cast<std::size_t>(standing)];
    if (count == 0) continue;
    std::string words(name(standing, group));
    if (count == 1 && words.starts_with("hold")) words.insert(4, "s");
    if (count == 1 && words.starts_with("do ")) words.insert(2, "es");
    if (words.starts_with("not ")) words.insert(0, count == 1 ? "is " : "are ");
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", count, words);
  }
  return text;
}

}  // namespace terrabench
