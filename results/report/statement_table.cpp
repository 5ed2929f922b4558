#include "results/report/statement_table.h"

#include <fmt/format.h>

#include <algorithm>

#include "results/report/report_tables.h"

namespace terrabench {
namespace {

// "Grounds: 2 of 3 hold (not: p.1.hills)." Sub-rows that were not measured are left out.
std::string holding(const Statement& statement, Variation varies, std::string_view title) {
  int measured = 0, holding = 0;
  std::string others;
  for (const Judgement* const row : statement.sub_rows) {
    if (row->claim->varies != varies || row->verdict > Verdict::kDiffers) continue;
    ++measured;
    if (holds(row->verdict)) {
      ++holding;
    } else {
      others += fmt::format("{}{}", others.empty() ? "" : ", ", row->claim->id);
    }
  }
  if (measured == 0) return "";
  return fmt::format("{}: {} of {} hold{}.", title, holding, measured,
                     others.empty() ? "" : fmt::format(" (not: {})", others));
}

std::string why(const Statement& statement, const Paper& paper) {
  std::string text;
  const auto add = [&](const std::string& sentence) {
    if (!sentence.empty()) text += (text.empty() ? "" : " ") + sentence;
  };
  const Claim& claim = *statement.claim->claim;
  const auto cause = std::ranges::find(paper.causes, claim.cause, &Cause::id);
  // An unexpected failure, or nothing measured, has another reason than the cause.
  if (cause != paper.causes.end() && statement.claim->verdict == Verdict::kDiffers &&
      statement.claim->check_failure.empty()) {
    add(cause->title + ".");
  } else {
    add(why_not(*statement.claim));
  }
  if (statement.reading != nullptr) {
    add(fmt::format("Holds as {}: {}.", statement.reading->claim->id, statement.reading->stated));
  }
  add(holding(statement, Variation::kReading, "Readings"));
  add(holding(statement, Variation::kGround, "Grounds"));
  add(holding(statement, Variation::kSetting, "Settings"));
  return text;
}

}  // namespace

std::string decided_by(const Judgement& j) {
  const ConditionResult& found = j.deciding;
  if (found.value.empty()) return "–";
  const std::string text =
      fmt::format("{}{}{}", found.quantity, found.quantity.empty() ? "" : ": ", found.value);
  const std::size_t conditions = j.claim->conditions.size();
  if (conditions == 1) return text;
  std::string_view why_this;
  if (found.outcome == ConditionResult::Outcome::kFails) {
    why_this = ": the first that fails";
  } else if (found.outcome == ConditionResult::Outcome::kHolds && found.margin) {
    why_this = ": the nearest to its bound";
  }
  const bool bound_here = !j.claim->tolerance.empty() && !found.expected.empty();
  return fmt::format("{} (condition {} of {}{}{})", text, j.deciding_condition + 1, conditions,
                     bound_here ? ", " + found.expected : "", why_this);
}

std::string why_not(const Judgement& j) {
  if (holds(j.verdict)) return j.check_failure;
  if (j.verdict != Verdict::kDiffers) return j.measured;
  // The note explains the known verdict, not one that nobody expected.
  if (!j.check_failure.empty()) return j.check_failure;
  if (j.claim->matches.empty()) return j.claim->reason();
  return fmt::format("{} Matches: {}", j.claim->reason(), j.claim->matches);
}

Cell standing_cell(const Statement& statement) {
  constexpr std::string_view kNames[] = {"holds", "holds in another reading", "does not hold", "not judged"},
                             kStyles[] = {"reproduced", "shape", "differs", "unrun"};
  const auto standing = static_cast<std::size_t>(statement.standing);
  return {std::string(kNames[standing]), "", "", "verdict " + std::string(kStyles[standing])};
}

Table statement_table(const JudgedResults& results, const Paper& paper, Group group) {
  constexpr std::string_view kIds[] = {"stated", "figures", "beyond"},
                             kTitles[] = {"Numbers and comparisons that the paper states", "Figures drawn",
                                          "What we ask beyond the paper"};
  const auto index = static_cast<std::size_t>(group);
  Table table{
      fmt::format("{}.{}", paper.id, kIds[index]),
      std::string(kTitles[index]),
      "What the paper says in our words, and the condition that decides: one that was not measured, else the "
      "first that fails, else the one nearest to its bound.",
      {{"Statement"}, {"The paper"}, {"Printed"}, {"Measured"}, {"Tolerance"}, {"Verdict"}, {"Why"}},
      {}};
  for (const Statement& statement : statements(results.of(paper))) {
    const Judgement& j = *statement.claim;
    const Claim& claim = *j.claim;
    if (claim.group != group) continue;
    table.rows.push_back({{.text = claim.id, .link = "#" + claim.id},
                          {where_and_statement(claim)},
                          {reported_text(claim)},
                          {decided_by(j)},
                          {claim.tolerance.empty() ? j.deciding.expected : claim.tolerance},
                          standing_cell(statement),
                          {why(statement, paper)}});
  }
  return table;
}

}  // namespace terrabench
