#include "results/report/discrepancies.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "results/claims/statements.h"
#include "results/report/fill.h"
#include "results/report/report_tables.h"
#include "results/report/statement_table.h"

namespace terrabench {
namespace {

class Page {
 public:
  Page(const JudgedResults& results, const Paper& paper)
      : paper_(paper), statements_(statements(results.of(paper))) {}

  // The statements of each cause under its text, and those that have a reason of their own.
  Document differing() const {
    Document document;
    for (const Cause& cause : paper_.causes) {
      Table table = statements_of(cause.id, cause.title, false);
      if (table.rows.empty()) continue;
      document.push_back(Heading{3, cause.title, cause.id});
      document.push_back(Paragraph{cause.text});
      document.push_back(TableBlock{std::move(table), {}});
    }
    Table others = statements_of("", "Each for a reason of its own", true);
    if (!others.rows.empty()) document.push_back(TableBlock{std::move(others), {}});
    return document;
  }

  // A row per cause: how many statements do not hold as printed for it.
  void count_into(Table& table) const {
    const auto add = [&](const std::string& cause, const std::string& title) {
      const Table differing = statements_of(cause, title, false);
      if (differing.rows.empty()) return;
      table.rows.push_back({{.text = title, .link = "wrong-or-vague.*#" + differing.id},
                            {paper_.id},
                            {std::to_string(differing.rows.size())}});
    };
    for (const Cause& cause : paper_.causes) add(cause.id, cause.title);
    add("", "Each for a reason of its own");
  }

  Table vague() const {
    Table table{"vague." + paper_.id,
                "The paper can be read in several ways",
                "What the paper leaves open, and what was measured under the readings.",
                {{"Statement"}, {"The paper"}, {"Left open"}, {"Measured"}, {"Verdict"}},
                {}};
    for (const Statement& statement : statements_) {
      const Claim& claim = *statement.claim->claim;
      if (claim.vague.empty() || statement.standing == Standing::kNotJudged) continue;
      table.rows.push_back({id_cell(claim),
                            {where_and_statement(claim)},
                            {claim.vague},
                            {claim.note.empty() ? statement.claim->measured : claim.note},
                            standing_cell(statement)});
    }
    return table;
  }

 private:
  // `with_reason`: with a column for it.
  Table statements_of(const std::string& cause, const std::string& title, bool with_reason) const {
    Table table{fmt::format("wrong.{}", cause.empty() ? paper_.id : cause),
                title,
                "What the paper says in our words, what it prints, and what was measured as printed.",
                {{"Statement"}, {"The paper"}, {"Printed"}, {"Measured as printed"}},
                {}};
    if (with_reason) table.columns.push_back({"Why"});
    table.columns.insert(table.columns.end(), {{"Verdict"}, {"What does hold"}});
    for (const Statement& statement : statements_) {
      const Judgement& j = *statement.claim;
      if (j.claim->group == Group::kBeyond || cause_of(j) != cause) continue;
      if (statement.standing != Standing::kOtherReading && statement.standing != Standing::kDoesNotHold)
        continue;
      std::vector<Cell> row = {
          id_cell(*j.claim), {where_and_statement(*j.claim)}, {reported_text(*j.claim)}, {j.deciding.text}};
      if (with_reason) row.push_back({why_not(j)});
      row.push_back(standing_cell(statement));
      row.push_back({matching(statement)});
      table.rows.push_back(std::move(row));
    }
    return table;
  }

  // A failure that nobody expected has another reason.
  static std::string cause_of(const Judgement& j) { return j.check_failure.empty() ? j.claim->cause : ""; }

  static Cell id_cell(const Claim& claim) { return {.text = claim.id, .link = "ledger.*#" + claim.id}; }

  std::string matching(const Statement& statement) const {
    const std::string& matches = statement.claim->claim->matches;
    const Judgement* match = statement.reading;
    for (const Statement& s : statements_) {
      if (s.claim->claim->id == matches) match = s.claim;
      for (const Judgement* const row : s.sub_rows) {
        if (row->claim->id == matches) match = row;
      }
    }
    if (match == nullptr) return matches;
    return fmt::format("{}, {}: {} {}", match->claim->id, name(match->verdict), match->claim->statement,
                       match->stated);
  }

  const Paper& paper_;
  std::vector<Statement> statements_;
};

}  // namespace

Table causes_of_differences(const JudgedResults& results, std::span<const Paper> papers) {
  Table table{"causes",
              "What does not hold as printed, and why",
              "Statements that do not hold, or only in another reading, by their cause.",
              {{"Cause"}, {"Paper"}, {"Statements", "", true}},
              {}};
  for (const Paper& paper : papers) Page(results, paper).count_into(table);
  return table;
}

Document discrepancies(const JudgedResults& results, std::span<const Paper> papers) {
  Document document = {Heading{1, std::string(kDiscrepanciesTitle), "top"},
                       Paragraph{fmt::format(
                           "Statements of the papers that the measurements of profile “{}” do not confirm as "
                           "printed, by their cause, and what the papers leave open. {}",
                           results.profile, standings_sentence(results))}};
  const std::size_t empty = document.size();
  for (const Paper& paper : papers) {
    const Page page(results, paper);
    Document differing = page.differing();
    Table vague = page.vague();
    if (differing.empty() && vague.rows.empty()) continue;
    document.push_back(Heading{2, paper.title, paper.id});
    std::ranges::move(differing, std::back_inserter(document));
    if (!vague.rows.empty()) document.push_back(TableBlock{std::move(vague), {}});
  }
  return document.size() == empty ? Document() : document;
}

}  // namespace terrabench
