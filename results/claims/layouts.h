// Which tables, plots, pages and rankings the report has: the entries of that name in a claims file.
#pragma once

#include <map>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "results/plot/plot.h"

namespace terrabench {

// A page of the report that shows in one place what belongs to one ground: the tables and plots whose `page`
// is its id, and figures. Figures that were not drawn are left out.
struct PageLayout {
  // The case that draws the figures; in a claims file "experiment/case".
  struct Drawn {
    std::string experiment, case_name;
    bool operator==(const Drawn&) const = default;
  };
  std::string id, about;        // about: a sentence that says what the ground is
  std::string label;            // what readers call the ground; the id if the file names it
  std::vector<Drawn> sheets;    // figures with many panels, each as wide as the page
  std::vector<Drawn> pictures;  // figures that stand side by side
};

// A table of the report. Its rows are cases of one experiment; a row's own values are what the paper printed
// (numbers) and ids of claims (text).
struct TableLayout {
  struct Row {
    std::string label, case_name;
    std::map<std::string, std::variant<double, std::string>, std::less<>> values = {};
    bool new_block = false;  // the first row of a block: growth is not from the row above
  };
  struct Column {
    enum class Kind { kReported, kMetric, kInterval, kGrowth, kSpeedUp, kVerdict };
    Kind kind = Kind::kMetric;
    std::string title, unit;
    std::string key;  // of Row::values; kReported, kSpeedUp (reported ÷ measured), kVerdict
    // kMetric, kInterval, kGrowth (÷ the row above), kSpeedUp. "<name>" stands for the row's text of that
    // name, so that the rows of one table may show different metrics.
    std::string metric;
  };
  std::string id, title, caption, experiment, rows_title;
  std::vector<Row> rows;
  std::vector<Column> columns;
  std::string page = {};  // id of the page that shows it; empty: its paper's page
};
// The metric with "<name>" replaced by the row's text; empty for a row without it.
std::string for_row(std::string metric, const TableLayout::Row&);
// The column with its metric for the row.
TableLayout::Column for_row(TableLayout::Column, const TableLayout::Row&);

// A plot of the report: lines through cases of an experiment, or through what the paper printed; or stacked
// bars.
struct PlotLayout {
  struct Series {
    std::string label, experiment, metric;
    std::string x_metric;  // of the same case, in place of the x of `cases`; empty: none
    // The samples of metric and x_metric belong together, one by one: a point for each distinct x of a case.
    bool paired = false;
    std::vector<std::pair<double, std::string>> cases;  // x, case
    std::vector<std::pair<double, double>> values;      // x, y as printed; used when cases is empty
    bool slope = false;                                 // fit a power law and say its exponent
  };
  std::string id, title, caption;
  PlotAxis x, y;
  std::vector<Series> series;
  std::string page = {};  // id of the page that shows it; empty: its paper's page
  // Of a plot of stacked bars: a bar per row, from the top, with a heading before the first of each group,
  // the rows' text `group`. Each series is a part, whose metric is read for the row as a table's column is;
  // the x of its cases is the number of the row. Bars are measured along x.
  std::vector<TableLayout::Row> rows = {};
};

// What methods are ranked by.
struct RankingLayout {
  using Entry = TableLayout::Row;
  std::string id, task, where;  // task: "Fewest bytes in memory"; where: "on caves"
  // Its place in the tables of findings (findings_table.h): the table, the row, and the column, which is a
  // ground with a page of that id; empty: in none. A headline has a sentence above the tables, too. The
  // question alone: a row of the advice for a ground (advice.h).
  std::string table, question, ground;
  bool headline = false;
  std::string kind;                   // answers are compared between grounds of the same kind; empty: of any
  std::vector<std::string> purposes;  // for whom the question matters: `terrabench advise --for`
  std::string experiment, metric;     // `metric` and `needs` are read for the entry as a table's columns are
  std::string unit;                   // that values are shown in
  bool most = false;                  // the best has the most, otherwise the least
  bool searched = false;              // the metric is of the best that a search found: kSearchMargin
  // An entry takes part only if this metric lies in the range, where any entry has it. Empty: none. The text
  // says so: "of types that come close to that error".
  std::string needs, needs_text;
  double needs_low = 0, needs_high = 0;
  std::vector<Entry> entries;
};

struct TomlValue;
// Throw bad_input with file and line for unknown or missing keys, wrong types, and a `page` that is not among
// the given pages.
PageLayout parse_page(const TomlValue&);
TableLayout parse_table(const TomlValue&, std::span<const PageLayout>);
PlotLayout parse_plot(const TomlValue&, std::span<const PageLayout>);
RankingLayout parse_ranking(const TomlValue&);

}  // namespace terrabench
