#include "results/report/fill.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <utility>

#include "results/store/format.h"
#include "results/store/statistics.h"

namespace terrabench {
namespace {

struct Unit {
  std::string_view name, kind;
  double size;
};

// Sizes are whole multiples of the smallest unit of the kind, so that no factor is rounded twice.
constexpr Unit kUnits[] = {{"s", "time", 1e9},   {"ms", "time", 1e6}, {"µs", "time", 1e3},
                           {"ns", "time", 1},    {"B", "bytes", 1},   {"kB", "bytes", 1e3},
                           {"MB", "bytes", 1e6}, {"GB", "bytes", 1e9}};

using ColumnKind = TableLayout::Column::Kind;

const Cell kNothing{"–"};

// That the table or plot shows the record.
void note(auto& filled, const Record& record) {
  if (std::ranges::count(filled.runs, record.run) == 0) filled.runs.push_back(record.run);
  filled.records.push_back(&record);
}

// "skipped" or "not defined"; a dash if the record does not say.
Cell absent_cell(const Record& record, std::string_view metric) {
  const std::optional<WhyAbsent> why = record.why_absent(metric);
  return why ? Cell{std::string(why->word)} : kNothing;
}

// `timed`: the number varies from run to run.
Cell number_cell(double number, bool timed = false) {
  return {format_number(printed(number, timed)), format_exact(number)};
}

Cell measured_cell(const TableLayout::Column& column, const TableLayout::Row& row, const Metric& metric) {
  const Summary s = summarise(metric);
  const bool varies = timed(metric);
  if (column.kind == ColumnKind::kMetric || column.kind == ColumnKind::kInterval) {
    if (column.kind == ColumnKind::kInterval && s.count < kFewestSamples) return kNothing;
    const std::optional<double> known = conversion(metric.unit, column.unit);
    const double factor = known.value_or(1), low = s.low * factor, high = s.high * factor;
    Cell cell = column.kind == ColumnKind::kMetric
                    ? number_cell(s.median * factor, varies)
                    : Cell{fmt::format("{} … {}", format_number(printed(low, varies)),
                                       format_number(printed(high, varies))),
                           fmt::format("{} … {}", format_exact(low), format_exact(high))};
    if (!known) {
      const std::string unit = metric.unit.empty() ? "without unit" : metric.unit;
      cell = {cell.text + " " + unit, cell.raw + " " + unit};
    }
    return cell;
  }
  const auto reported = row.values.find(column.key);
  if (reported == row.values.end() || !std::holds_alternative<double>(reported->second)) return kNothing;
  return number_cell(std::get<double>(reported->second) / s.median, varies);
}

// Empty across machines or builds, whose times cannot be compared.
Cell growth_cell(const std::string& metric, const Record* before, const Record* record, const Store& store) {
  const Metric* const from = before == nullptr ? nullptr : before->find(metric);
  const Metric* const to = record == nullptr ? nullptr : record->find(metric);
  if (from == nullptr || to == nullptr || from->unit != to->unit) return kNothing;
  const Provenance* const earlier = store.run(before->run);
  const Provenance* const later = store.run(record->run);
  if (earlier == nullptr || later == nullptr || !comparable(*earlier, *later)) return kNothing;
  return number_cell(median(to->samples) / median(from->samples), timed(*to));
}

// Whether a row has something to show without a measurement: a value as printed, or a verdict.
bool speaks_alone(const TableLayout& layout, const TableLayout::Row& row) {
  return std::ranges::any_of(layout.columns, [&](const TableLayout::Column& column) {
    return !column.key.empty() && row.values.contains(column.key);
  });
}

// Whether the record has one of the row's metrics, or says why the case has none.
bool measured(const TableLayout& layout, const TableLayout::Row& row, const Record* record) {
  if (record == nullptr) return false;
  if (record->outcome != CaseOutcome::kMeasured) return true;
  return std::ranges::any_of(layout.columns, [&](const TableLayout::Column& column) {
    return record->find(for_row(column, row).metric) != nullptr;
  });
}

// The points of a paired series, by x.
std::vector<PlotPoint> paired_points(const Metric& metric, const Metric& across, double up, double right) {
  std::map<double, std::vector<double>> at;
  for (std::size_t i = 0; i < std::min(metric.samples.size(), across.samples.size()); ++i) {
    at[across.samples[i] * right].push_back(metric.samples[i]);
  }
  std::vector<PlotPoint> points;
  for (const auto& [x, samples] : at) {
    const Summary s = summarise(samples);
    points.push_back({x, s.median * up, s.low * up, s.high * up});
  }
  return points;
}

Cell cell_for(const TableLayout::Column& column, const TableLayout::Row& row, const Record* record,
              const JudgedResults& results) {
  const auto value = row.values.find(column.key);
  const bool given = value != row.values.end();
  if (column.kind == ColumnKind::kReported) {
    return given && std::holds_alternative<double>(value->second)
               ? number_cell(std::get<double>(value->second))
               : kNothing;
  }
  if (column.kind == ColumnKind::kVerdict) {
    if (!given || !std::holds_alternative<std::string>(value->second)) return kNothing;
    const std::string& id = std::get<std::string>(value->second);
    const auto it = std::ranges::find(results.judgements, id, [](const Judgement& j) { return j.claim->id; });
    return it == results.judgements.end() ? kNothing : verdict_cell(*it);
  }
  if (record == nullptr) return kNothing;
  const Metric* const metric = record->find(column.metric);
  return metric == nullptr ? absent_cell(*record, column.metric) : measured_cell(column, row, *metric);
}

}  // namespace

std::optional<double> conversion(std::string_view from, std::string_view to) {
  if (from == to) return 1;
  const auto find = [](std::string_view name) {
    return std::find_if(std::begin(kUnits), std::end(kUnits), [&](const Unit& u) { return u.name == name; });
  };
  const Unit *const a = find(from), *const b = find(to);
  // Counts may be shown without the name of what is counted, ratios with ×.
  if ((to.empty() && a == std::end(kUnits)) || (from.empty() && to == "×")) return 1;
  if (a == std::end(kUnits) || b == std::end(kUnits) || a->kind != b->kind) return std::nullopt;
  return a->size / b->size;
}

Cell verdict_cell(const Judgement& judgement) {
  // The style is the verdict's last word, such as "shape" or "run".
  constexpr std::string_view kStyles[] = {"reproduced",   "shape", "differs",
                                          "incomparable", "unrun", "missing"};
  return {std::string(name(judgement.verdict)), "", "",
          "verdict " + std::string(kStyles[static_cast<std::size_t>(judgement.verdict)])};
}

FilledTable fill(const TableLayout& layout, const Store& store, const JudgedResults& results) {
  FilledTable filled;
  filled.table = {layout.id, layout.title, layout.caption, {{layout.rows_title}}, {}};
  for (const TableLayout::Column& column : layout.columns) {
    filled.table.columns.push_back({column.title, column.unit, column.kind != ColumnKind::kVerdict});
  }
  const Record* before = nullptr;
  for (const TableLayout::Row& row : layout.rows) {
    const Record* const record = store.find(layout.experiment, row.case_name, results.profile);
    const Record* const above = std::exchange(before, record);
    const Record* const grown_from = row.new_block ? nullptr : above;
    if (!measured(layout, row, record) && !speaks_alone(layout, row)) continue;
    if (record != nullptr) note(filled, *record);
    std::vector<Cell> cells = {{row.label}};
    for (const TableLayout::Column& general : layout.columns) {
      const TableLayout::Column column = for_row(general, row);
      cells.push_back(column.kind == ColumnKind::kGrowth
                          ? growth_cell(column.metric, grown_from, record, store)
                          : cell_for(column, row, record, results));
    }
    filled.table.rows.push_back(std::move(cells));
  }
  return filled;
}

namespace {

// Where the parts of a row's bar end, one after another from 0; empty if a part was not measured.
std::vector<double> bar_ends(const PlotLayout& layout, const TableLayout::Row& row, const Store& store,
                             const std::string& profile) {
  std::vector<double> ends{0};
  for (const PlotLayout::Series& part : layout.series) {
    const Record* const record = store.find(part.experiment, row.case_name, profile);
    const Metric* const metric = record == nullptr ? nullptr : record->find(for_row(part.metric, row));
    const std::optional<double> factor =
        metric == nullptr ? std::nullopt : conversion(metric->unit, layout.x.unit);
    if (!factor) return {};
    ends.push_back(ends.back() + median(metric->samples) * *factor);
  }
  return ends;
}

FilledPlot fill_bars(const PlotLayout& layout, const Store& store, const std::string& profile) {
  FilledPlot filled{{layout.title, layout.x, layout.y, {}}, {}};
  Plot& plot = filled.plot;
  for (const PlotLayout::Series& part : layout.series) plot.series.push_back({part.label, {}});
  std::string group;
  for (const TableLayout::Row& row : layout.rows) {
    const std::vector<double> ends = bar_ends(layout, row, store, profile);
    if (ends.empty()) continue;
    note(filled, *store.find(layout.series[0].experiment, row.case_name, profile));
    const std::string of = for_row("<group>", row);
    if (of != group) plot.rows.push_back(group = of);
    const auto number = static_cast<double>(plot.rows.size());
    plot.rows.push_back(row.label);
    for (std::size_t k = 0; k < plot.series.size(); ++k) {
      plot.series[k].points.push_back({ends[k + 1], number, ends[k], ends[k + 1]});
    }
  }
  return filled;
}

}  // namespace

FilledPlot fill(const PlotLayout& layout, const Store& store, const std::string& profile) {
  if (!layout.rows.empty()) return fill_bars(layout, store, profile);
  FilledPlot filled{{layout.title, layout.x, layout.y, {}}, {}};
  for (const PlotLayout::Series& series : layout.series) {
    PlotSeries& line = filled.plot.series.emplace_back();
    line.label = series.label;
    line.reported = series.cases.empty();
    int left_out = 0;
    for (const auto& [x, y] : series.values) line.points.push_back({x, y, y, y});
    for (const auto& [x, case_name] : series.cases) {
      const Record* const record = store.find(series.experiment, case_name, profile);
      const Metric* const metric = record == nullptr ? nullptr : record->find(series.metric);
      const Metric* const across =
          record == nullptr || series.x_metric.empty() ? nullptr : record->find(series.x_metric);
      if (metric == nullptr || (across == nullptr && !series.x_metric.empty())) continue;
      const std::optional<double> up = conversion(metric->unit, layout.y.unit),
                                  right = across == nullptr ? 1 : conversion(across->unit, layout.x.unit);
      if (!up || !right) {
        ++left_out;
        continue;
      }
      note(filled, *record);
      if (series.paired) {
        const std::vector<PlotPoint> points = paired_points(*metric, *across, *up, *right);
        line.points.insert(line.points.end(), points.begin(), points.end());
        continue;
      }
      const Summary s = summarise(*metric);
      const double at = across == nullptr ? x : median(across->samples) * *right;
      line.points.push_back({at, s.median * *up, s.low * *up, s.high * *up});
    }
    if (left_out > 0) line.label += fmt::format(", {} in other units left out", left_out);
    if (!series.slope) continue;
    if (const auto slope = power_law(line.points)) line.label += fmt::format(", slope {:.2f}", *slope);
  }
  return filled;
}

}  // namespace terrabench
