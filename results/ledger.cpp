#include "results/ledger.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <utility>

#include "results/fill.h"
#include "results/report_tables.h"
#include "results/tally.h"

namespace terrabench {
namespace {

constexpr std::pair<char, std::string_view> kClasses[] = {
    {'E', "E, exact"}, {'T', "T, tolerance"}, {'S', "S, shape"}, {'F', "F, figure"}, {'Q', "Q, qualitative"}};

std::string class_name(char letter) {
  const auto* const at = std::ranges::find(kClasses, letter, &std::pair<char, std::string_view>::first);
  return at == std::end(kClasses) ? std::string(1, letter) : std::string(at->second);
}

// Why the verdict is not "reproduced"; empty if it is.
std::string why(const Judgement& j) {
  if (j.verdict == Verdict::kReproduced || j.verdict == Verdict::kShape) return j.complaint;
  if (j.verdict != Verdict::kDiffers) return j.measured;
  // The note explains the known verdict, not one that nobody expected.
  if (!j.complaint.empty()) return j.complaint;
  if (j.claim->matches.empty()) return j.claim->reason();
  return fmt::format("{} Matches: {}", j.claim->reason(), j.claim->matches);
}

// The figure that decides and, of a claim with several conditions, which one it is of and why; with its
// bound, unless column “Tolerance” shows that.
std::string ours(const Judgement& j) {
  const Finding& found = j.deciding;
  if (found.value.empty()) return "–";
  const std::string text =
      fmt::format("{}{}{}", found.quantity, found.quantity.empty() ? "" : ": ", found.value);
  const std::size_t conditions = j.claim->conditions.size();
  if (conditions == 1) return text;
  std::string_view why_this;
  if (found.outcome == Finding::Outcome::kFails) {
    why_this = ": the first that fails";
  } else if (found.outcome == Finding::Outcome::kHolds && found.room) {
    why_this = ": the nearest to its bound";
  }
  const bool bound_here = !j.claim->tolerance.empty() && !found.expected.empty();
  return fmt::format("{} (condition {} of {}{}{})", text, j.deciding_condition + 1, conditions,
                     bound_here ? ", " + found.expected : "", why_this);
}

class Rows {
 public:
  Rows(const Store& store, const JudgedResults& results, std::span<const Paper> papers,
       const LedgerLinks& links)
      : store_(store), results_(results), links_(links), where_shown_(papers, links.shown) {}

  std::vector<Cell> row(const Judgement& j) const {
    const Claim& claim = *j.claim;
    return {{.text = claim.id, .anchor = claim.id},
            verdict_cell(j),
            {where_and_statement(claim)},
            {reported_text(claim)},
            {ours(j)},
            {claim.tolerance.empty() ? j.deciding.expected : claim.tolerance},
            {class_name(claim.claim_class)},
            {std::string(name(claim.about))},
            {why(j)},
            figure(j),
            run(j)};
  }

 private:
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
    const auto& [id, title, ground] = place->layout;
    return {.text = fmt::format("{}{}", title, place->same_quantity ? "" : " (same case, other quantities)"),
            .link = fmt::format("{}#{}", page_file(ground, links_.form), id)};
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
    return {.text = text, .link = std::string(links_.form.main_page) + "#" + run_anchor(j.runs.back())};
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
  Table table{"ledger",
              "Every row",
              "Claim, what the paper says in our words and what it prints, what was measured, and why the "
              "verdict is not “reproduced” where it is not. The figure or table is the picture that the "
              "row judges, otherwise the first table or plot that shows its verdict or one of its "
              "numbers. Lines are those of measurements.jsonl. Of a row with several conditions, “Measured” "
              "shows the first that fails or, if all hold, the one nearest to a bound. The distance is "
              "|value − bound| ÷ max(|value|, |bound|), or 1 if that is less. A lower bound of 0 does not "
              "count, nor does an upper bound of 1 that is the best value of a share. A condition without a "
              "bound that counts, such as an equality or a picture, is shown if a row of class E begins with "
              "it or if no condition of the row has such a bound. A condition that was not measured is shown "
              "before all others. Conditions are numbered after “each” of the claims file is expanded.",
              {{"Claim"},
               {"Verdict"},
               {"The paper"},
               {"Printed"},
               {"Measured"},
               {"Tolerance"},
               {"Class"},
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

Table class_table(const JudgedResults& results) {
  Table table{"ledger-counts",
              "Verdicts by kind and class",
              "Rows about a paper, rows about rules of this program, rows that hold by arithmetic alone, and "
              "repeats of a row are counted apart. Exact rows must be equal; rows of class shape compare a "
              "ratio, a slope or an order.",
              {{"Rows"}, {"Class"}},
              {}};
  std::vector<Verdict> verdicts;
  for (const Verdict verdict : kVerdictColumns) {
    if (std::ranges::count(results.judgements, verdict, &Judgement::verdict) == 0) continue;
    verdicts.push_back(verdict);
    table.columns.push_back({std::string(name(verdict)), "", true});
  }
  table.columns.push_back({"all", "", true});
  const auto add = [&](About about, std::string_view class_text, const auto& belongs) {
    VerdictCounts counts;
    int all = 0;
    for (const Judgement& j : results.judgements) {
      if (j.claim->about == about && belongs(j)) ++counts[j.verdict], ++all;
    }
    if (all == 0) return;
    std::vector<Cell> row = {{std::string(name(about))}, {std::string(class_text)}};
    for (const Verdict verdict : verdicts) row.push_back({std::to_string(counts[verdict])});
    row.push_back({std::to_string(all)});
    table.rows.push_back(std::move(row));
  };
  for (const About about : kAllAbout) {
    for (const auto& [letter, text] : kClasses) {
      add(about, text, [&](const Judgement& j) { return j.claim->claim_class == letter; });
    }
    add(about, "all", [](const Judgement&) { return true; });
  }
  return table;
}

Document ledger(const Store& store, const JudgedResults& results, std::span<const Paper> papers,
                const LedgerLinks& links) {
  std::string counts;
  for (const auto& [about, verdicts] : tally(results.judgements)) {
    counts += fmt::format("{}{}: {}", counts.empty() ? "" : "; ", name(about), counts_text(verdicts));
  }
  std::vector<Link> pages = {{"Report", std::string(links.form.main_page)}};
  pages.insert(pages.end(), links.grounds.begin(), links.grounds.end());
  return {Heading{1, "Ledger", "top"},
          Paragraph{fmt::format("{} rows, judged from the measurements of profile “{}”. Of these, {}.",
                                results.judgements.size(), results.profile, counts),
                    false, std::move(pages)},
          Heading{2, "Counts", "counts"},
          TableBlock{class_table(results), {}},
          Heading{2, "Rows", "rows"},
          TableBlock{ledger_table(store, results, papers, links), {{"CSV", "tables/ledger.csv"}}, true}};
}

}  // namespace terrabench
