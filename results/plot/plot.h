// Line plots with error bars on linear or logarithmic axes, and stacked bars, drawn by VTK's charts and
// written as SVG.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace terrabench {

struct PlotPoint {
  double x, y, low, high;  // low, high: the ends of the error bar, both equal to y for none
};

struct PlotSeries {
  std::string label;
  std::vector<PlotPoint> points;  // any order
  bool reported = false;          // by a paper or a theory, not measured; drawn grey and dashed
};

struct PlotAxis {
  std::string label, unit;
  bool log = false;
};

struct Plot {
  std::string title;  // for screen readers; the caption belongs to the page
  PlotAxis x, y;
  std::vector<PlotSeries> series;
  // Labels of rows, from the top. If there are any, the plot shows stacked bars along x in place of lines,
  // and has no axis y: a point is a part of the bar in row y, from `low` to x, and each series is one kind of
  // part, in the order in which they are stacked. A row without points is a heading.
  std::vector<std::string> rows = {};
};

// Pixels. A picture of `width` pixels with letters of `font` pixels, printed 174 mm wide, has letters of
// 493 pt × font ÷ width.
struct PlotSize {
  int width, height, font;
};
// For a page on a screen. The legend stands above the axes, which keep their size.
PlotSize screen_size(const Plot&);
// For print: a page's width (174 mm), a column's (84 mm); letters of 8 pt.
PlotSize page_size(const Plot&);
PlotSize column_size(const Plot&);

// Points that a logarithmic axis cannot show are left out; throws bad_input when no point is left. Not
// thread-safe (VTK's fonts are one object). The same plot gives the same bytes.
std::string plot_svg(const Plot&, const PlotSize&);
inline std::string plot_svg(const Plot& plot) { return plot_svg(plot, screen_size(plot)); }

// The exponent of the power law through the points (least squares of the logarithms); nothing for fewer than
// two distinct x, nor where an x or y is not above 0.
std::optional<double> power_law(std::span<const PlotPoint>);

}  // namespace terrabench
