#include "results/plot/plot.h"

#include <fmt/format.h>
#include <vtkAxis.h>
#include <vtkBrush.h>
#include <vtkChartLegend.h>
#include <vtkChartXY.h>
#include <vtkContext2D.h>
#include <vtkContextScene.h>
#include <vtkDoubleArray.h>
#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPen.h>
#include <vtkPlotLine.h>
#include <vtkStringArray.h>
#include <vtkTable.h>
#include <vtkTextProperty.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>

#include "results/plot/axis_scale.h"
#include "results/plot/svg_device.h"
#include "results/store/format.h"
#include "results/store/power_law.h"
#include "terrain/error.h"

namespace terrabench {
namespace {

constexpr const char* kFont = "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf";

// Okabe & Ito (2008): distinguishable with every kind of colour vision, and in print; the eighth is of Tol
// (2021).
struct Style {
  std::array<unsigned char, 3> colour;
  int marker;
  int line = vtkPen::SOLID_LINE;
};
constexpr std::array<Style, 8> kStyles = {{{{0x00, 0x72, 0xB2}, vtkPlotPoints::CIRCLE},
                                           {{0xD5, 0x5E, 0x00}, vtkPlotPoints::SQUARE},
                                           {{0x00, 0x9E, 0x73}, vtkPlotPoints::DIAMOND},
                                           {{0xCC, 0x79, 0xA7}, vtkPlotPoints::CROSS},
                                           {{0xE6, 0x9F, 0x00}, vtkPlotPoints::PLUS},
                                           {{0x56, 0xB4, 0xE9}, vtkPlotPoints::CIRCLE},
                                           {{0x00, 0x00, 0x00}, vtkPlotPoints::SQUARE},
                                           {{0x88, 0x22, 0x55}, vtkPlotPoints::DIAMOND}}};
// Of what was not measured here.
constexpr std::array<Style, 3> kReported = {{{{0x60, 0x60, 0x60}, vtkPlotPoints::SQUARE, vtkPen::DASH_LINE},
                                             {{0x98, 0x98, 0x98}, vtkPlotPoints::DIAMOND, vtkPen::DASH_LINE},
                                             {{0xB8, 0xB8, 0xB8}, vtkPlotPoints::CIRCLE, vtkPen::DASH_LINE}}};

// The style of the measured series `number`: once all colours are used, they come again with another marker
// and dashes.
Style measured_style(std::size_t number) {
  Style style = kStyles[number % kStyles.size()];
  if (number >= kStyles.size()) {
    style.marker = kStyles[(number / kStyles.size() + number) % 5].marker;
    style.line = vtkPen::DASH_DOT_LINE;
  }
  return style;
}

SvgDevice* device_of(vtkContext2D* painter) { return SvgDevice::SafeDownCast(painter->GetDevice()); }

// "Time: 0.12 ms".
std::string value_text(const PlotAxis& axis, double value) {
  return fmt::format("{}: {}", axis.label, format_quantity(value, axis.unit));
}

// A line with error bars; the chart's coordinates are ours (already logarithms where the axis is
// logarithmic).
class ErrorBarLine : public vtkPlotLine {
 public:
  static ErrorBarLine* New();
  vtkTypeMacro(ErrorBarLine, vtkPlotLine)

      void set_hints(std::vector<std::string> hints) {
    hints_ = std::move(hints);
  }
  void set_bars(std::vector<std::array<float, 3>> bars, float cap) {
    bars_ = std::move(bars);
    cap_ = cap;
  }
  bool Paint(vtkContext2D* painter) override {
    device_of(painter)->set_hints(hints_);
    // VTK warns about a line through one point, so only its marker is drawn.
    const bool painted =
        GetInput()->GetNumberOfRows() < 2 ? vtkPlotPoints::Paint(painter) : vtkPlotLine::Paint(painter);
    device_of(painter)->set_hints({});
    painter->ApplyPen(Pen);
    painter->GetPen()->SetLineType(vtkPen::SOLID_LINE);
    painter->GetPen()->SetWidth(1.8F);
    for (const auto& [x, low, high] : bars_) {
      std::array<float, 12> lines = {x,        low,  x,        high,  //
                                     x - cap_, low,  x + cap_, low,   //
                                     x - cap_, high, x + cap_, high};
      painter->DrawLines(lines.data(), 6);
    }
    return painted;
  }

 protected:
  ErrorBarLine() = default;

 private:
  std::vector<std::string> hints_;          // of the points
  std::vector<std::array<float, 3>> bars_;  // x, low, high
  float cap_ = 0;
};
vtkStandardNewMacro(ErrorBarLine)

    void set_font(vtkTextProperty* property, int size) {
  if (std::filesystem::exists(kFont)) {
    property->SetFontFamily(VTK_FONT_FILE);
    property->SetFontFile(kFont);
  }
  property->SetFontSize(size);
  property->SetBold(0);
  property->SetItalic(0);
  property->SetColor(0.1, 0.1, 0.1);
}

void set_axis(vtkAxis* axis, const PlotAxis& what, const AxisScale& scale, int font,
              const std::vector<std::string>& rows = {}) {
  axis->SetTitle(what.unit.empty() ? what.label : fmt::format("{} [{}]", what.label, what.unit));
  axis->SetBehavior(vtkAxis::FIXED);
  axis->SetRange(scale.low, scale.high);
  vtkNew<vtkDoubleArray> positions;
  vtkNew<vtkStringArray> labels;
  for (std::size_t k = 0; k < scale.ticks.size(); ++k) {
    positions->InsertNextValue(scale.chart(scale.ticks[k]));
    labels->InsertNextValue(rows.empty() ? tick_label(scale.ticks[k]) : rows[k]);
  }
  if (!rows.empty()) axis->SetGridVisible(false);
  axis->SetCustomTickPositions(positions, labels);
  set_font(axis->GetTitleProperties(), font);
  set_font(axis->GetLabelProperties(), font);
  axis->GetPen()->SetColor(60, 60, 60);
  axis->GetPen()->SetWidth(1.4F);
  axis->GetGridPen()->SetColor(222, 222, 222);
  axis->GetGridPen()->SetWidth(1.0F);
}

void set_points(vtkPlot* plot, const std::vector<std::array<float, 2>>& points) {
  vtkNew<vtkTable> table;
  for (const std::size_t axis : {0U, 1U}) {
    vtkNew<vtkFloatArray> values;
    values->SetName(axis == 0 ? "x" : "y");
    for (const auto& point : points) values->InsertNextValue(point[axis]);
    table->AddColumn(values);
  }
  plot->SetInputData(table, 0, 1);
}

// `above`: the number of series drawn later. Lines that coincide can all be seen, since each is wider than
// those above it, with larger markers.
void add_series(vtkChartXY* chart, const Plot& plot, const PlotSeries& series, const Style& style,
                std::size_t above, const AxisScale& x, const AxisScale& y) {
  std::vector<std::array<float, 2>> points;
  std::vector<std::string> hints;
  std::vector<std::array<float, 3>> bars;
  for (const PlotPoint& point : series.points) {
    points.push_back({static_cast<float>(x.chart(point.x)), static_cast<float>(y.chart(point.y))});
    hints.push_back(
        fmt::format("{} · {} · {}", series.label, value_text(plot.x, point.x), value_text(plot.y, point.y)));
    if (point.low < point.high)
      hints.back() += fmt::format(" [{}, {}]", format_number(point.low), format_number(point.high));
    if (point.low < point.high && (!y.log || point.low > 0)) {
      bars.push_back({static_cast<float>(x.chart(point.x)), static_cast<float>(y.chart(point.low)),
                      static_cast<float>(y.chart(point.high))});
    }
  }
  vtkNew<ErrorBarLine> line;
  set_points(line, points);
  line->set_hints(std::move(hints));
  line->SetLabel("\u00a0" + series.label);  // VTK leaves no room between the legend's symbol and its text
  line->SetColor(style.colour[0], style.colour[1], style.colour[2], 255);
  const auto wider = static_cast<float>(above);
  line->SetWidth(2.5F + 0.8F * wider);
  line->GetPen()->SetLineType(style.line);
  line->SetMarkerStyle(style.marker);
  line->SetMarkerSize(11.0F + 1.0F * wider);
  line->set_bars(std::move(bars), static_cast<float>((x.high - x.low) * 0.008));
  chart->AddPlot(line);
}

// One kind of part of stacked bars. In the chart, row 0 is at y = 0 and the others lie below.
class BarParts : public vtkPlotLine {
 public:
  static BarParts* New();
  vtkTypeMacro(BarParts, vtkPlotLine)

      struct Part {
    float from, to, y;
    std::string words;  // after the end; may be empty
    std::string hint;   // under the pointer
  };
  void set_parts(std::vector<Part> parts, int font) {
    parts_ = std::move(parts);
    set_font(text_, font);
    text_->SetVerticalJustificationToCentered();
  }
  bool Paint(vtkContext2D* painter) override {
    constexpr float kThick = 0.72F;  // of a row
    painter->ApplyPen(Pen);
    painter->GetBrush()->SetColor(Pen->GetColorObject());
    painter->ApplyTextProp(text_);
    for (const Part& part : parts_) {
      device_of(painter)->set_hints({part.hint});
      painter->DrawRect(part.from, part.y - kThick / 2, part.to - part.from, kThick);
      if (!part.words.empty()) painter->DrawString(part.to, part.y, part.words.c_str());
    }
    return true;
  }
  bool PaintLegend(vtkContext2D* painter, const vtkRectf& box, int) override {
    painter->ApplyPen(Pen);
    painter->GetBrush()->SetColor(Pen->GetColorObject());
    painter->DrawRect(box.GetX(), box.GetY(), box.GetWidth(), box.GetHeight());
    return true;
  }

 protected:
  BarParts() = default;

 private:
  std::vector<Part> parts_;
  vtkNew<vtkTextProperty> text_;
};
vtkStandardNewMacro(BarParts)

    // From dark to light, so that they differ in print without colours, too.
    constexpr std::array<std::size_t, 3> kPartStyles = {0, 4, 5};

constexpr int kWordsAfterBar = 9;  // letters for which there is room

// `last`: whether the parts end their bars, after which the bar's length is printed.
void add_parts(vtkChartXY* chart, const Plot& plot, const PlotSeries& series, std::size_t number,
               const AxisScale& x, int font, bool last) {
  std::vector<BarParts::Part> parts;
  std::vector<std::array<float, 2>> ends;
  for (const PlotPoint& point : series.points) {
    const double from = x.log && point.low <= 0 ? x.low : x.chart(point.low);
    parts.push_back({static_cast<float>(from), static_cast<float>(x.chart(point.x)),
                     static_cast<float>(-point.y), last ? "\u00a0" + format_number(point.x) : "",
                     fmt::format("{} · {} · {}", plot.rows[static_cast<std::size_t>(point.y)], series.label,
                                 value_text(plot.x, point.x - point.low))});
    ends.push_back({parts.back().to, parts.back().y});
  }
  const Style& style = kStyles[kPartStyles[number % kPartStyles.size()]];
  vtkNew<BarParts> bars;
  set_points(bars, ends);
  bars->SetLabel("\u00a0" + series.label);
  bars->SetColor(style.colour[0], style.colour[1], style.colour[2], 255);
  bars->SetWidth(0.5F);
  bars->set_parts(std::move(parts), font);
  chart->AddPlot(bars);
}

// The points that both axes can show, from left to right.
std::vector<PlotSeries> showable(const Plot& plot) {
  std::vector<PlotSeries> all = plot.series;
  for (PlotSeries& series : all) {
    std::erase_if(series.points,
                  [&](const PlotPoint& p) { return !shown(plot.x, p.x) || !shown(plot.y, p.y); });
    std::stable_sort(series.points.begin(), series.points.end(), [](auto& a, auto& b) { return a.x < b.x; });
  }
  return all;
}

// `size` of a line plot without its legend; `line`: pixels per line of text.
PlotSize size_for(const Plot& plot, PlotSize size, int line) {
  if (!plot.rows.empty()) size.height = line * (4 + static_cast<int>(plot.rows.size()));
  size.height += line * static_cast<int>(plot.series.size());
  return size;
}

}  // namespace

// The legend stands above the chart, a line per series.
PlotSize screen_size(const Plot& plot) { return size_for(plot, {880, 485, 17}, 25); }
PlotSize page_size(const Plot& plot) { return size_for(plot, {880, 400, 14}, 20); }
PlotSize column_size(const Plot& plot) { return size_for(plot, {440, 310, 15}, 20); }

namespace {

void set_legend(vtkChartLegend* legend, int font) {
  set_font(legend->GetLabelProperties(), font);
  legend->SetSymbolWidth(44);
  legend->SetPadding(8);
  // Above the plot, where it covers nothing.
  legend->SetInline(false);
  legend->SetHorizontalAlignment(vtkChartLegend::CENTER);
  legend->SetVerticalAlignment(vtkChartLegend::TOP);
  legend->GetPen()->SetColor(200, 200, 200);
}

void add_all(vtkChartXY* chart, const Plot& plot, const std::vector<PlotSeries>& all, const AxisScale& x,
             const AxisScale& y, int font) {
  std::size_t measured = 0, reported = 0;
  for (const PlotSeries& series : all) {
    if (!plot.rows.empty()) {
      add_parts(chart, plot, series, measured++, x, font, &series == &all.back());
      continue;
    }
    const Style style =
        series.reported ? kReported[reported++ % kReported.size()] : measured_style(measured++);
    // Number of series drawn after this one, which widens its line so that it shows below them; at most
    // kMostAbove, for the widest line.
    constexpr std::ptrdiff_t kMostAbove = 5;
    const std::ptrdiff_t above = std::count_if(&series + 1, all.data() + all.size(),
                                               [](const PlotSeries& s) { return !s.points.empty(); });
    if (!series.points.empty())
      add_series(chart, plot, series, style, static_cast<std::size_t>(std::min(above, kMostAbove)), x, y);
  }
}

}  // namespace

std::string plot_svg(const Plot& plot, const PlotSize& size) {
  const std::vector<PlotSeries> all = showable(plot);
  std::vector<double> xs, ys;
  for (const PlotSeries& series : all) {
    for (const PlotPoint& point : series.points) {
      xs.push_back(point.x);
      ys.push_back(point.y);
      if (shown(plot.y, point.low)) ys.push_back(point.low);
      if (shown(plot.y, point.high)) ys.push_back(point.high);
    }
  }
  if (xs.empty()) throw bad_input("there is no point to plot", plot.title, "measure the cases that it shows");
  const bool bars = !plot.rows.empty();
  AxisScale x = scale_for(plot.x, xs, !bars, 0.06);
  const AxisScale y = bars ? scale_of_rows(plot.rows.size()) : scale_for(plot.y, ys, false, 0.08);
  // Beside the labels and the title of the vertical axis.
  int pixels = size.width - 8 * size.font;
  if (bars) {
    pixels -= 8 * size.font;
    x.high += (x.high - x.low) * 0.6 * size.font * kWordsAfterBar / pixels;
  }
  x.ticks = spaced_ticks(x, pixels, size.font);

  vtkNew<vtkChartXY> chart;
  chart->SetAutoSize(false);
  chart->SetSize(vtkRectf(0, 0, static_cast<float>(size.width) - 12, static_cast<float>(size.height) - 8));
  set_axis(chart->GetAxis(vtkAxis::BOTTOM), plot.x, x, size.font);
  set_axis(chart->GetAxis(vtkAxis::LEFT), plot.y, y, size.font, plot.rows);
  add_all(chart, plot, all, x, y, size.font);
  chart->SetShowLegend(true);
  set_legend(chart->GetLegend(), size.font);

  vtkNew<vtkContextScene> scene;
  scene->AddItem(chart);
  scene->SetGeometry(size.width, size.height);
  vtkNew<SvgDevice> device;
  vtkNew<vtkContext2D> painter;
  // The first painting lays the chart out, the second draws it there.
  for (int pass = 0; pass < 2; ++pass) {
    device->start(size.width, size.height);
    painter->Begin(device);
    scene->Paint(painter);
    painter->End();
  }
  return device->svg(plot.title);
}

std::optional<double> power_law(std::span<const PlotPoint> points) {
  std::vector<double> x, y;
  for (const PlotPoint& point : points) {
    x.push_back(point.x);
    y.push_back(point.y);
  }
  const std::optional<PowerLaw> law = fit_power_law(x, y);
  return law ? std::optional(law->exponent) : std::nullopt;
}

}  // namespace terrabench
