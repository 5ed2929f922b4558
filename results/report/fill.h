// Fills the tables and plots that a claims file lays out with the measurements.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "results/claims/judge.h"
#include "results/plot/plot.h"
#include "results/report/table.h"
#include "results/store/store.h"

namespace terrabench {

struct FilledTable {
  Table table;
  std::vector<std::string> runs;            // that its figures come from; empty when nothing was measured
  std::vector<const Record*> records = {};  // the cases that it shows, as far as it shows single ones
};
// Leaves out rows with neither a measurement nor a figure of the paper; a figure that was not measured is a
// dash, or the record's word for it, such as "not defined", and one whose unit cannot be converted to the
// column's stands with its own.
FilledTable fill(const TableLayout&, const Store&, const JudgedResults&);

struct FilledPlot {
  Plot plot;
  std::vector<std::string> runs;
  std::vector<const Record*> records = {};
};
// The label of a series with `slope` gives the exponent of its power law; that of a series with points whose
// units cannot be converted to the axes' says how many are left out.
FilledPlot fill(const PlotLayout&, const Store&, const std::string& profile);

// The factor from `from` to `to`. Times (s, ms, µs, ns) and bytes (B, kB, MB, GB) are converted; any other
// unit only to itself or to none; none to ×. Nothing for other pairs.
std::optional<double> conversion(std::string_view from, std::string_view to);

// A verdict with its style: colour and sign, so that neither is needed alone.
Cell verdict_cell(const Judgement&);

}  // namespace terrabench
