#include "results/report/ledger.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <tuple>
#include <variant>

#include "results/report/fill.h"
#include "results/report/report_tables.h"
#include "results/report/statement_table.h"

namespace terrabench {
namespace {

// Finds the table or plot that shows the numbers of a claim.
class WhereShown {
 public:
  struct Place {
    std::string_view id, title;
    std::string page;  // stem of the page
  };

  // Tables come before plots, both in the papers' order.
  WhereShown(std::span<const Paper> papers, const LedgerLinks& links) {
    for (const Paper& paper : papers) {
      for (const TableLayout& table : paper.tables) {
        if (links.shown.contains(table.id)) add(paper, table);
      }
    }
    for (const Paper& paper : papers) {
      for (const PlotLayout& plot : paper.plots) {
        if (!links.shown.contains(plot.id)) continue;
        for (const PlotLayout::Series& series : plot.series) {
          for (const auto& [x, name] : series.cases) {
            for (const std::string& metric : {series.metric, series.x_metric})
              add(series.experiment, name, metric, {plot.id, plot.title, page_of(paper, plot.page)});
          }
        }
      }
    }
  }

  // The first with a row that names the claim; otherwise the first that shows a metric that the claim reads;
  // otherwise the first that shows other metrics of a case that it reads, with whether it is this. Nothing if
  // no such case was measured and is shown.
  std::optional<std::pair<Place, bool>> find(const Claim& claim, const Store& store,
                                             std::string_view profile) const {
    if (const auto named = by_claim_.find(claim.id); named != by_claim_.end())
      return std::pair(named->second, false);
    for (const bool of_case : {false, true}) {
      for (const Condition& condition : claim.conditions) {
        for (const Operand& read : condition.operands) {
          const auto shown =
              places_.find({read.experiment, read.case_name, of_case ? kAnyMetric : read.metric});
          const Record* const record = store.find(read.experiment, read.case_name, profile);
          if (shown != places_.end() && record != nullptr && record->find(read.metric) != nullptr)
            return std::pair(shown->second, of_case);
        }
      }
    }
    return std::nullopt;
  }

 private:
  static constexpr const char* kAnyMetric = "";

  static std::string page_of(const Paper& paper, const std::string& ground) {
    return ground.empty() ? paper_page(paper) : ground_page(ground);
  }

  void add(const Paper& paper, const TableLayout& table) {
    const Place place{table.id, table.title, page_of(paper, table.page)};
    for (const TableLayout::Row& row : table.rows) {
      for (const auto& [key, value] : row.values) {
        // Other texts of a row do no harm.
        if (const auto* const text = std::get_if<std::string>(&value)) by_claim_.try_emplace(*text, place);
      }
      for (const TableLayout::Column& column : table.columns)
        add(table.experiment, row.case_name, for_row(column, row).metric, place);
    }
  }
  void add(std::string_view experiment, std::string_view name, const std::string& metric,
           const Place& place) {
    for (const std::string& of : {metric, std::string(kAnyMetric)})
      places_.try_emplace({experiment, name, of}, place);
  }

  std::map<std::string_view, Place> by_claim_;
  std::map<std::tuple<std::string_view, std::string_view, std::string>, Place> places_;
};

class Rows {
 public:
  Rows(const Store& store, const JudgedResults& results, std::span<const Paper> papers,
       const LedgerLinks& links)
      : store_(store), results_(results), links_(links), where_shown_(papers, links) {}

  std::vector<Cell> row(const Judgement& j) const {
    const Claim& claim = *j.claim;
    return {{.text = claim.id, .anchor = claim.id},
            verdict_cell(j),
            {where_and_statement(claim)},
            {reported_text(claim)},
            {decided_by(j)},
            {claim.tolerance.empty() ? j.deciding.expected : claim.tolerance},
            {part_of(claim)},
            {why_not(j)},
            figure(j),
            run(j)};
  }

 private:
  // "ground of p.1"; of a claim, its group.
  static std::string part_of(const Claim& claim) {
    if (claim.of.empty()) return std::string(name(claim.group));
    return fmt::format("{} of {}", name(claim.varies), claim.of);
  }

  // The picture that the claim judges, otherwise the table or plot that shows its numbers.
  Cell figure(const Judgement& j) const {
    for (const Condition& condition : j.claim->conditions) {
      if (condition.kind != Condition::Kind::kFigure) continue;
      const RecordedFigure* const drawn = store_.find_figure(condition.figure, results_.profile).second;
      if (drawn == nullptr) continue;
      const std::string file = picture_file(*drawn);
      return {.text = condition.figure, .link = links_.pictures.contains(file) ? file : ""};
    }
    const auto place = where_shown_.find(*j.claim, store_, results_.profile);
    if (!place) return {"–"};
    const auto& [shown, other_metrics] = *place;
    const auto& [id, title, page] = shown;
    return {.text = fmt::format("{}{}", title, other_metrics ? " (same case, other quantities)" : ""),
            .link = fmt::format("{}.*#{}", page, id)};
  }

  // The run that was read last, and the lines of measurements.jsonl that were.
  Cell run(const Judgement& j) const {
    if (j.runs.empty()) return {"–"};
    std::set<std::size_t> lines;
    for (const Condition& condition : j.claim->conditions) {
      if (condition.kind == Condition::Kind::kFigure) {
        note_line(lines, store_.find_figure(condition.figure, results_.profile).first);
      }
      for (const auto* const operands : {&condition.operands, &condition.brightness}) {
        for (const Operand& o : *operands) {
          if (!o.is_number()) note_line(lines, store_.find(o.experiment, o.case_name, results_.profile));
        }
      }
    }
    constexpr std::size_t kShown = 3;
    std::string text = fmt::format("{}, line", short_id(j.runs.back()));
    std::size_t shown = 0;
    for (const std::size_t line : lines) {
      if (shown == kShown) break;
      text += fmt::format("{} {}", shown == 0 ? (lines.size() == 1 ? "" : "s") : ",", line);
      ++shown;
    }
    if (lines.size() > shown) text += fmt::format(" and {} more", lines.size() - shown);
    return {.text = text, .link = "runs.*#" + run_anchor(j.runs.back())};
  }

  void note_line(std::set<std::size_t>& lines, const Record* record) const {
    if (record != nullptr) lines.insert(store_.line(*record));
  }

  const Store& store_;
  const JudgedResults& results_;
  const LedgerLinks& links_;
  WhereShown where_shown_;
};

}  // namespace

Table ledger_table(const Store& store, const JudgedResults& results, std::span<const Paper> papers,
                   const LedgerLinks& links) {
  Table table{
      "ledger",
      "Every row",
      "Statements, and below each its other readings, settings and grounds. “Measured” shows the condition "
      "that decides: one that was not measured, else the first that fails, else the one nearest to its "
      "bound. Lines are those of measurements.jsonl.",
      {{"Row"},
       {"Verdict"},
       {"The paper"},
       {"Printed"},
       {"Measured"},
       {"Tolerance"},
       {"Counts as"},
       {"Why"},
       {"Figure or table"},
       {"Run"}},
      {}};
  const Rows rows(store, results, papers, links);
  for (const Paper& paper : papers) {
    for (const Judgement& judgement : results.of(paper)) table.rows.push_back(rows.row(judgement));
  }
  return table;
}

Document ledger(const Store& store, const JudgedResults& results, std::span<const Paper> papers,
                const LedgerLinks& links) {
  Document document = {
      Heading{1, "Ledger", "top"},
      Paragraph{fmt::format("What each paper states, and whether the measurements of profile “{}” agree. {}",
                            results.profile, standings_sentence(results))},
      Search{"Find claims with all of these words:", "ledger.*"}, Heading{2, "Counts", "counts"},
      TableBlock{summary_table(results, papers), {}}};
  for (const Paper& paper : papers) {
    if (results.of(paper).empty()) continue;
    document.push_back(Heading{2, paper.title, paper.id});
    for (const Group group : kGroups) {
      if (Table table = statement_table(results, paper, group); !table.rows.empty())
        document.push_back(TableBlock{std::move(table), {}});
    }
    Facts notes = claim_notes(results, paper);
    if (notes.lines.empty()) continue;
    document.push_back(Heading{3, "Notes", paper.id + "-notes"});
    document.push_back(std::move(notes));
  }
  document.push_back(Heading{2, "Every row", "rows"});
  document.push_back(
      TableBlock{ledger_table(store, results, papers, links), {{"CSV", "tables/ledger.csv"}}, true});
  return document;
}

}  // namespace terrabench
