#include "results/plot/axis_scale.h"

#include <fmt/format.h>

#include <algorithm>

#include "results/store/format.h"

namespace terrabench {
namespace {

// 1, 2 or 5 times a power of ten; about five steps cover the span.
double round_step(double span) {
  const double step = span / 5, power = std::pow(10, std::floor(std::log10(step)));
  const double mantissa = step / power;
  return power * (mantissa <= 1.5 ? 1 : mantissa <= 3.5 ? 2 : mantissa <= 7.5 ? 5 : 10);
}

std::vector<double> log_ticks(double low, double high) {
  std::vector<double> ticks;
  const bool few = high - low < 2;  // decades
  const int stride = std::max(1, static_cast<int>((high - low) / 8));
  for (int power = static_cast<int>(std::floor(low)); power <= high; power += stride) {
    for (const double digit : {1.0, 2.0, 5.0}) {
      const double value = digit * std::pow(10, power), at = std::log10(value);
      if ((digit == 1 || few) && at >= low && at <= high) ticks.push_back(value);
    }
  }
  return ticks;
}

}  // namespace

AxisScale scale_for(const PlotAxis& axis, std::vector<double> values, bool own_ticks, double margin) {
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
  AxisScale scale{axis.log, 0, 1, {}};
  scale.low = scale.chart(values.front());
  scale.high = scale.chart(values.back());
  // A linear axis starts at zero, so that differences are not exaggerated.
  if (!axis.log) scale.low = std::min(scale.low, 0.0);
  double span = scale.high - scale.low;
  if (span <= 0) span = axis.log ? 1 : std::max(1e-12, std::abs(scale.high));
  // A marker on the axis itself would be cut in half.
  if (axis.log || values.front() <= 0) scale.low -= margin * span;
  scale.high += margin * span;
  if (axis.log && own_ticks && values.size() <= 8) {
    scale.ticks = values;
  } else if (axis.log) {
    scale.ticks = log_ticks(scale.low, scale.high);
  } else {
    const double step = round_step(scale.high - scale.low);
    for (double at = std::ceil(scale.low / step); at * step <= scale.high; ++at)
      scale.ticks.push_back(at * step);
  }
  return scale;
}

AxisScale scale_of_rows(std::size_t rows) {
  AxisScale scale{false, 0.4 - static_cast<double>(rows), 0.6, {}};
  for (std::size_t row = 0; row < rows; ++row) scale.ticks.push_back(-static_cast<double>(row));
  return scale;
}

std::string tick_label(double tick) {
  const double size = std::abs(tick);
  if (size < 1e-7 || size >= 1e-4) return format_number(tick);
  return fmt::format("{:.{}f}", tick, -static_cast<int>(std::floor(std::log10(size) + 1e-9)));
}

std::vector<double> spaced_ticks(const AxisScale& scale, double pixels, int font) {
  constexpr double kDigit = 0.64;  // width of a DejaVu Sans digit, in font sizes
  std::vector<double> kept;
  double end = -pixels;
  for (const double tick : scale.ticks) {
    const double at = (scale.chart(tick) - scale.low) / (scale.high - scale.low) * pixels;
    const double half = kDigit * font * static_cast<double>(tick_label(tick).size()) / 2;
    if (at - half < end + font / 2.0) continue;
    kept.push_back(tick);
    end = at + half;
  }
  return kept;
}

}  // namespace terrabench
