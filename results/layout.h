// Fills the tables and plots that a claims file lays out with what was measured.
#pragma once

#include <string>
#include <vector>

#include "results/check.h"
#include "results/claims.h"
#include "results/plot.h"
#include "results/store.h"
#include "results/table.h"

namespace terrabench {

struct FilledTable {
  Table table;
  std::vector<std::string> runs;  // that its figures came from; empty when nothing was measured
};
// Rows with neither a measurement nor a figure of the paper are left out; what was not measured is a dash.
FilledTable fill(const TableLayout&, const Store&, const CheckReport&);

struct FilledPlot {
  Plot plot;
  std::vector<std::string> runs;
};
// A series that asks for its slope says it in its label.
FilledPlot fill(const PlotLayout&, const Store&, const std::string& profile);

// The verdict with a class of its own: colour and sign, so that neither is needed alone.
Cell verdict_cell(const Row&);

}  // namespace terrabench
