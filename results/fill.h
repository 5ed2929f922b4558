// Fills the tables and plots that a claims file lays out with the measurements.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "results/judge.h"
#include "results/plot.h"
#include "results/store.h"
#include "results/table.h"

namespace terrabench {

struct FilledTable {
  Table table;
  std::vector<std::string> runs;  // that its figures come from; empty when nothing was measured
};
// Leaves out rows with neither a measurement nor a figure of the paper; a figure that was not measured is a
// dash. Throws bad_input when a metric's unit cannot be shown in the column's.
FilledTable fill(const TableLayout&, const Store&, const JudgedResults&);

struct FilledPlot {
  Plot plot;
  std::vector<std::string> runs;
};
// The label of a series with `slope` gives the exponent of its power law. Throws as above.
FilledPlot fill(const PlotLayout&, const Store&, const std::string& profile);

// The factor from `from` to `to`. Times (s, ms, µs, ns) and bytes (B, kB, MB, GB) are converted; any other
// unit only to itself or to none; none to ×. Throws bad_input for other pairs, naming the metric and where it
// was read ("file:line").
double conversion(std::string_view from, std::string_view to, std::string_view metric,
                  std::string_view where);

// A verdict with its style: colour and sign, so that neither is needed alone.
Cell verdict_cell(const Judgement&);

}  // namespace terrabench
