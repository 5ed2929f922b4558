// Which tables and plots the report shows: the [[table]] and [[plot]] entries of a claims file.
#pragma once

#include <map>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "results/plot.h"

namespace terrabench {

// A table of the report. Its rows are cases of one experiment; a row's own values are what the paper printed
// (numbers) and ids of claims (text).
struct TableLayout {
  struct Row {
    std::string label, case_name;
    std::map<std::string, std::variant<double, std::string>, std::less<>> values;
  };
  struct Column {
    enum class Kind { kReported, kMetric, kInterval, kGrowth, kSpeedUp, kVerdict };
    Kind kind = Kind::kMetric;
    std::string title, unit;
    std::string key;  // of Row::values; kReported, kSpeedUp (reported ÷ measured), kVerdict
    // kMetric, kInterval, kGrowth (÷ the row before), kSpeedUp. "<name>" stands for the row's text of that
    // name, so that the rows of one table may show different metrics.
    std::string metric;
  };
  std::string id, title, caption, experiment, rows_title;
  std::vector<Row> rows;
  std::vector<Column> columns;
};

// A plot of the report: lines through cases of an experiment, or through what the paper printed.
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
};

struct TomlValue;
// Throw bad_input with file and line for unknown or missing keys and wrong types.
TableLayout parse_table(const TomlValue&);
PlotLayout parse_plot(const TomlValue&);

}  // namespace terrabench
