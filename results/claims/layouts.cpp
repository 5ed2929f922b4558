#include "results/claims/layouts.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>

#include "results/claims/toml_reader.h"

namespace terrabench {
namespace {

// The names of all "<name>" in these metrics.
std::vector<std::string> named_texts(std::span<const std::string> metrics) {
  std::vector<std::string> names;
  for (const std::string& metric : metrics) {
    const std::size_t open = metric.find('<'), close = metric.find('>', open);
    if (close != std::string::npos) names.push_back(metric.substr(open + 1, close - open - 1));
  }
  return names;
}

// `known`: which keys the row may have beside its label and its case.
TableLayout::Row row_from(const TomlValue& node, std::span<const std::string> known) {
  TomlTable entry(node);
  TableLayout::Row row{entry.text("label"), entry.get("case").case_name("case"), {}, entry.flag("new_block")};
  for (const std::string& key : known) {
    if (!entry.has(key)) continue;
    const TomlValue value = entry.get(key);
    if (value.node->is_string()) {
      row.values.emplace(key, value.text(key));
    } else {
      row.values.emplace(key, value.number(key));
    }
  }
  entry.refuse_unknown();
  return row;
}

TableLayout::Column column_from(const TomlValue& node) {
  using Kind = TableLayout::Column::Kind;
  constexpr std::pair<std::string_view, Kind> kKinds[] = {
      {"reported", Kind::kReported}, {"metric", Kind::kMetric},    {"interval", Kind::kInterval},
      {"growth", Kind::kGrowth},     {"speed_up", Kind::kSpeedUp}, {"verdict", Kind::kVerdict}};
  TomlTable entry(node);
  TableLayout::Column column;
  column.title = entry.text("title");
  column.unit = entry.text_or("unit", "");
  const auto* const kind =
      std::find_if(std::begin(kKinds), std::end(kKinds), [&](const auto& k) { return entry.has(k.first); });
  if (kind == std::end(kKinds)) {
    entry.refuse("a column is one of reported, metric, interval, growth, speed_up, verdict");
  }
  column.kind = kind->second;
  if (column.kind == Kind::kSpeedUp) {
    const auto [key, metric] = entry.get("speed_up").pair("speed_up");
    column.key = key.text("speed_up");
    column.metric = metric.text("speed_up");
  } else {
    const bool measured =
        column.kind == Kind::kMetric || column.kind == Kind::kInterval || column.kind == Kind::kGrowth;
    (measured ? column.metric : column.key) = entry.text(kind->first);
  }
  entry.refuse_unknown();
  return column;
}

PlotAxis axis_from(const TomlValue& node) {
  TomlTable entry(node);
  PlotAxis axis{entry.text("label"), entry.text_or("unit", ""), entry.flag("log")};
  entry.refuse_unknown();
  return axis;
}

PlotLayout::Series series_from(const TomlValue& node) {
  TomlTable entry(node);
  PlotLayout::Series series;
  series.label = entry.text("label");
  series.slope = entry.flag("slope");
  for (const TomlValue& point : entry.list("values")) {
    const auto [x, y] = point.pair("values");
    series.values.emplace_back(x.number("values"), y.number("values"));
  }
  series.x_metric = entry.text_or("x_metric", "");
  series.paired = entry.flag("paired");
  if (series.paired && series.x_metric.empty()) entry.refuse("a paired series needs an 'x_metric'");
  for (const TomlValue& point : entry.list("cases")) {
    if (!series.x_metric.empty()) {
      series.cases.emplace_back(0, point.case_name("cases"));
      continue;
    }
    const auto [x, case_name] = point.pair("cases");
    series.cases.emplace_back(x.number("cases"), case_name.case_name("cases"));
  }
  if (series.values.empty() == series.cases.empty()) entry.refuse("a series has either 'values' or 'cases'");
  if (!series.cases.empty()) {
    series.experiment = entry.text("experiment");
    series.metric = entry.text("metric");
  }
  entry.refuse_unknown();
  return series;
}

// The rows and parts of a plot of stacked bars.
void read_bars(TomlTable& entry, PlotLayout& plot) {
  const std::string experiment = entry.text("experiment");
  std::vector<std::string> metrics;
  for (const TomlValue& value : entry.list("parts")) {
    TomlTable part(value);
    PlotLayout::Series& series = plot.series.emplace_back();
    series.label = part.text("label");
    series.metric = metrics.emplace_back(part.text("metric"));
    series.experiment = experiment;
    part.refuse_unknown();
  }
  std::vector<std::string> known = named_texts(metrics);
  known.emplace_back("group");
  for (const TomlValue& row : entry.list("rows")) plot.rows.push_back(row_from(row, known));
  for (PlotLayout::Series& series : plot.series) {
    for (std::size_t k = 0; k < plot.rows.size(); ++k) {
      series.cases.emplace_back(static_cast<double>(k), plot.rows[k].case_name);
    }
  }
  if (plot.series.empty()) entry.refuse("a plot with rows needs parts");
}

// The page that a table or a plot names; empty: none.
std::string page_from(TomlTable& entry, std::span<const PageLayout> pages) {
  const std::string page = entry.text_or("page", "");
  if (!page.empty() && std::ranges::count(pages, page, &PageLayout::id) == 0) {
    entry.refuse(fmt::format("unknown page '{}'", page));
  }
  return page;
}

std::vector<PageLayout::Drawn> drawn_from(TomlTable& entry, std::string_view key) {
  std::vector<PageLayout::Drawn> drawn;
  for (const TomlValue& node : entry.list(key)) {
    const std::string path = node.text(key);
    const std::size_t slash = path.find('/');
    if (slash == path.npos || slash == 0 || slash + 1 == path.size()) {
      node.fail(fmt::format("'{}' lists cases that draw figures, as \"experiment/case\"", key));
    }
    drawn.push_back({path.substr(0, slash), node.file->named(path.substr(slash + 1))});
  }
  return drawn;
}

}  // namespace

PageLayout parse_page(const TomlValue& node) {
  TomlTable entry(node);
  const std::string id = entry.text("id");
  PageLayout page{id, entry.text("about"), id, drawn_from(entry, "sheets"), drawn_from(entry, "pictures")};
  entry.refuse_unknown();
  return page;
}

TableLayout parse_table(const TomlValue& node, std::span<const PageLayout> pages) {
  TomlTable entry(node);
  TableLayout table;
  table.id = entry.text("id");
  table.title = entry.text("title");
  table.caption = entry.text("caption");
  table.experiment = entry.text("experiment");
  table.rows_title = entry.text("rows_title");
  std::vector<std::string> metrics, known{"claim"};  // without a column, too: the row is where it is shown
  for (const TomlValue& value : entry.list("columns")) {
    const TableLayout::Column& column = table.columns.emplace_back(column_from(value));
    metrics.push_back(column.metric);
    if (!column.key.empty()) known.push_back(column.key);
  }
  for (std::string& name : named_texts(metrics)) known.push_back(std::move(name));
  for (const TomlValue& row : entry.list("rows")) table.rows.push_back(row_from(row, known));
  if (table.rows.empty() || table.columns.empty()) entry.refuse("a table needs rows and columns");
  table.page = page_from(entry, pages);
  entry.refuse_unknown();
  return table;
}

PlotLayout parse_plot(const TomlValue& node, std::span<const PageLayout> pages) {
  TomlTable entry(node);
  PlotLayout plot;
  plot.id = entry.text("id");
  plot.title = entry.text("title");
  plot.caption = entry.text("caption");
  plot.x = axis_from(entry.get("x"));
  if (entry.has("rows")) {
    read_bars(entry, plot);
  } else {
    plot.y = axis_from(entry.get("y"));
    for (const TomlValue& series : entry.list("series")) plot.series.push_back(series_from(series));
    if (plot.series.empty()) entry.refuse("a plot needs series");
  }
  plot.page = page_from(entry, pages);
  entry.refuse_unknown();
  return plot;
}

RankingLayout parse_ranking(const TomlValue& node) {
  TomlTable entry(node);
  RankingLayout layout;
  layout.id = entry.text("id");
  layout.task = entry.text("task");
  layout.where = entry.text("where");
  layout.ground = entry.text_or("ground", "");
  layout.table = entry.text_or("table", "");
  layout.question = entry.text_or("question", "");
  layout.headline = entry.flag("headline");
  layout.kind = entry.text_or("kind", "");
  for (const TomlValue& purpose : entry.list("purposes")) layout.purposes.push_back(purpose.text("purposes"));
  if (!layout.ground.empty() && (layout.table.empty() || layout.question.empty()))
    entry.refuse("a ranking with a 'ground' needs a 'table' and a 'question'");
  layout.experiment = entry.text("experiment");
  layout.metric = entry.text("metric");
  layout.unit = entry.text_or("unit", "");
  const std::string best = entry.text("best");
  if (best != "most" && best != "least") entry.refuse("'best' is either most or least");
  layout.most = best == "most";
  layout.searched = entry.flag("searched");
  if (entry.has("needs")) {
    TomlTable needs(entry.get("needs"));
    layout.needs = needs.text("metric");
    layout.needs_text = needs.text("text");
    const auto [low, high] = needs.get("range").pair("range");
    layout.needs_low = low.number("range");
    layout.needs_high = high.number("range");
    needs.refuse_unknown();
  }
  const std::vector<std::string> known = named_texts(std::array{layout.metric, layout.needs});
  for (const TomlValue& value : entry.list("entries")) {
    layout.entries.push_back(row_from(value, known));
  }
  entry.refuse_unknown();
  return layout;
}

std::string for_row(std::string metric, const TableLayout::Row& row) {
  const std::size_t open = metric.find('<'), close = metric.find('>', open);
  if (close == std::string::npos) return metric;
  const auto value = row.values.find(std::string_view(metric).substr(open + 1, close - open - 1));
  const std::string* const text =
      value == row.values.end() ? nullptr : std::get_if<std::string>(&value->second);
  return text == nullptr ? "" : metric.replace(open, close - open + 1, *text);
}

TableLayout::Column for_row(TableLayout::Column column, const TableLayout::Row& row) {
  column.metric = for_row(std::move(column.metric), row);
  return column;
}

}  // namespace terrabench
