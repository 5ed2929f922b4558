#include "results/report/where_shown.h"

#include <algorithm>
#include <variant>

namespace terrabench {
namespace {

// How well a shown metric stands for one that a claim reads: first, whether it is the same; second, for
// another metric, how many letters of their names agree from the start. Metrics of one kind start alike, such
// as rmse_mean and rmse_largest.
using Likeness = std::pair<bool, std::size_t>;

Likeness likeness(std::string_view shown, std::string_view read) {
  if (shown == read) return {true, 0};
  const auto end = std::ranges::mismatch(shown, read).in1;
  return {false, static_cast<std::size_t>(end - shown.begin())};
}

}  // namespace

WhereShown::WhereShown(std::span<const Paper> papers, const ShownIds& shown) {
  const auto in_report = [&](const auto& layout) { return shown.contains(layout.id); };
  for (const Paper& paper : papers) {
    for (const TableLayout& table : paper.tables) {
      if (in_report(table)) add(table);
    }
  }
  for (const Paper& paper : papers) {
    for (const PlotLayout& plot : paper.plots) {
      if (in_report(plot)) add(plot);
    }
  }
}

void WhereShown::add(const TableLayout& table) {
  const Layout layout{table.id, table.title, table.page};
  for (const TableLayout::Row& row : table.rows) {
    for (const auto& [key, value] : row.values) {
      if (const auto* const text = std::get_if<std::string>(&value)) by_claim_.try_emplace(*text, layout);
    }
    for (const TableLayout::Column& column : table.columns) {
      add(table.experiment, row.case_name, for_row(column, row).metric, layout);
    }
  }
}

void WhereShown::add(const PlotLayout& plot) {
  for (const PlotLayout::Series& series : plot.series) {
    for (const auto& [x, case_name] : series.cases) {
      for (const std::string* const metric : {&series.metric, &series.x_metric}) {
        add(series.experiment, case_name, *metric, {plot.id, plot.title, plot.page});
      }
    }
  }
}

void WhereShown::add(std::string_view experiment, std::string_view case_name, const std::string& metric,
                     const Layout& layout) {
  if (!metric.empty()) by_case_[{experiment, case_name}].push_back({metric, layout});
}

std::optional<WhereShown::Place> WhereShown::find(const Claim& claim, const Store& store,
                                                  std::string_view profile) const {
  if (const auto named = by_claim_.find(claim.id); named != by_claim_.end())
    return Place{named->second, true};
  const Shown* nearest = nullptr;
  Likeness best;
  for (const Condition& condition : claim.conditions) {
    for (const Operand& operand : condition.operands) {
      const auto of_case = by_case_.find({operand.experiment, operand.case_name});
      if (of_case == by_case_.end()) continue;
      const Record* const record = store.find(operand.experiment, operand.case_name, profile);
      if (record == nullptr) continue;
      for (const Shown& shown : of_case->second) {
        const Likeness alike = likeness(shown.metric, operand.metric);
        if (nearest != nullptr && alike <= best) continue;
        if (record->find(shown.metric) == nullptr) continue;  // a dash in the table
        nearest = &shown;
        best = alike;
      }
    }
  }
  if (nearest == nullptr) return std::nullopt;
  return Place{nearest->layout, best.first};
}

}  // namespace terrabench
