#include "results/report/unclaimed_cases.h"

#include <algorithm>
#include <set>
#include <string>
#include <utility>

namespace terrabench {
namespace {

using Shown = std::set<std::pair<std::string, std::string>>;  // experiment, case

// Adds the cases that the claim reads and those that drew the pictures which it judges.
void add_cases(const Claim& claim, const Store& store, std::string_view profile, Shown& shown) {
  for (const Condition& condition : claim.conditions) {
    for (const auto* const operands : {&condition.operands, &condition.brightness}) {
      for (const Operand& operand : *operands) shown.emplace(operand.experiment, operand.case_name);
    }
    if (condition.kind != Condition::Kind::kFigure) continue;
    const Record* const drew = store.find_figure(condition.figure, profile).first;
    if (drew != nullptr) shown.emplace(drew->experiment, drew->case_name);
  }
}

void add_shown(const Paper& paper, const Store& store, std::string_view profile, Shown& shown) {
  for (const TableLayout& table : paper.tables) {
    for (const TableLayout::Row& row : table.rows) shown.emplace(table.experiment, row.case_name);
  }
  for (const PlotLayout& plot : paper.plots) {
    for (const PlotLayout::Series& series : plot.series) {
      for (const auto& [x, name] : series.cases) shown.emplace(series.experiment, name);
    }
  }
  for (const Claim& claim : paper.claims) add_cases(claim, store, profile, shown);
}

// Cases that are on the page for their picture alone.
void add_drawn(const PageLayout& page, Shown& shown) {
  for (const PageLayout::Drawn& drawn : page.sheets) shown.emplace(drawn.experiment, drawn.case_name);
}

const TableLayout* table_of(std::string_view experiment, std::span<const Paper> papers) {
  for (const Paper& paper : papers) {
    for (const TableLayout& table : paper.tables) {
      if (table.experiment == experiment) return &table;
    }
  }
  return nullptr;
}

bool any_has(std::span<const Record* const> records, std::string_view metric) {
  return std::ranges::any_of(records, [&](const Record* r) { return r->find(metric) != nullptr; });
}

std::vector<TableLayout::Column> columns_for(std::span<const Record* const> records,
                                             const TableLayout* like) {
  std::vector<TableLayout::Column> columns;
  if (like != nullptr) {
    for (const TableLayout::Column& column : like->columns) {
      if (column.kind == TableLayout::Column::Kind::kMetric && any_has(records, column.metric))
        columns.push_back(column);
    }
  }
  if (!columns.empty()) return columns;
  for (const Record* const record : records) {
    for (const Metric& metric : record->metrics) {
      if (std::ranges::count(columns, metric.name, &TableLayout::Column::metric) > 0) continue;
      columns.push_back({TableLayout::Column::Kind::kMetric, metric.name, metric.unit, "", metric.name});
    }
  }
  return columns;
}

}  // namespace

std::vector<TableLayout> unclaimed_cases(const Store& store, std::span<const Paper> papers,
                                         std::span<const FurtherGround> further, std::string_view profile) {
  Shown shown;
  for (const Paper& paper : papers) add_shown(paper, store, profile, shown);
  for (const FurtherGround& ground : further) {
    add_shown(ground.paper, store, profile, shown);
    add_drawn(ground.page(), shown);
  }
  std::vector<std::pair<std::string, std::vector<const Record*>>> experiments;
  for (const Record& record : store.records()) {
    if (record.profile != profile || record.metrics.empty()) continue;
    if (shown.contains({record.experiment, record.case_name})) continue;
    auto at = std::find_if(experiments.begin(), experiments.end(),
                           [&](const auto& e) { return e.first == record.experiment; });
    if (at == experiments.end()) at = experiments.insert(at, {record.experiment, {}});
    at->second.push_back(&record);
  }
  const GroundLabels labels = labels_of_grounds(store, profile);
  std::vector<TableLayout> tables;
  for (const auto& [experiment, records] : experiments) {
    TableLayout table{experiment + ".unclaimed",
                      experiment,
                      "Medians of cases that no claim is about: other terrain, other parameters.",
                      experiment,
                      "Case",
                      {},
                      columns_for(records, table_of(experiment, papers))};
    for (const Record* const record : records) {
      const bool fits = std::ranges::any_of(
          table.columns, [&](const TableLayout::Column& c) { return record->find(c.metric) != nullptr; });
      if (fits) {
        table.rows.push_back({labelled(record->case_name, *record, labels), record->case_name, {}});
      }
    }
    tables.push_back(std::move(table));
  }
  return tables;
}

}  // namespace terrabench
