// What an axis of a plot shows, and its ticks.
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "results/plot/plot.h"

namespace terrabench {

// Chart coordinates are logarithms on a logarithmic axis, so VTK needs to know of none.
struct AxisScale {
  bool log = false;
  double low = 0, high = 1;   // chart coordinates
  std::vector<double> ticks;  // true values

  double chart(double value) const { return log ? std::log10(value) : value; }
};

inline bool shown(const PlotAxis& axis, double value) {
  return std::isfinite(value) && (!axis.log || value > 0);
}

// `values` are those of all points, at least one. On a logarithmic axis with few values and own_ticks, each
// is a tick.
AxisScale scale_for(const PlotAxis&, std::vector<double> values, bool own_ticks, double margin);
// Rows from the top, at y = 0, -1, …
AxisScale scale_of_rows(std::size_t rows);

// Plain digits where format_number would write an exponent, as for small times.
std::string tick_label(double tick);
// The ticks of a horizontal axis of this many pixels whose labels keep clear of the label before.
std::vector<double> spaced_ticks(const AxisScale&, double pixels, int font);

}  // namespace terrabench
