// Figure 4: the error matrices over the parameters.
#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "experiments/drill/figures.h"
#include "experiments/figures/maps.h"

namespace terrabench::drill {
namespace {

constexpr double kCellWidth = 70, kCellHeight = 36, kLeft = 62, kTop = 64, kBelow = 62, kGap = 20,
                 kRight = 8;  // for the last label of a scale
constexpr double kMatrixWidth = kCellWidth * kInfluences.size(), kMatrixHeight = kCellHeight * kTaus.size();

// How errors are printed: multiplied by `times`, with `digits` after the point.
struct Figures {
  double times;
  int digits;
  std::string of(double error) const { return fmt::format("{:.{}f}", times * error, digits); }
};

struct Scale {
  double low, high;
  double at(double error) const { return high > low ? (error - low) / (high - low) : 0; }
  double value(double at) const { return low + at * (high - low); }
};

void add_matrix(figures::Sheet& sheet, double x0, double y0, int w, const std::vector<Outcome>& outcomes,
                const ErrorOf& error, const Scale& scale, const Figures& figures) {
  sheet.text(x0, y0 - 8, fmt::format("w = {}", w), 14);
  sheet.panel(x0, y0, kMatrixWidth - 1, kMatrixHeight - 1);
  for (const Outcome& o : outcomes) {
    if (o.setting.w != w) continue;
    const auto column = std::find(kInfluences.begin(), kInfluences.end(), o.setting.k) - kInfluences.begin();
    const auto row = std::find(kTaus.begin(), kTaus.end(), o.setting.tau) - kTaus.begin();
    const double x = x0 + static_cast<double>(column) * kCellWidth,
                 y = y0 + static_cast<double>(row) * kCellHeight;
    const Rgb colour = figures::error_colour(scale.at(error(o)));
    sheet.box(x, y, kCellWidth - 1, kCellHeight - 1, colour);
    sheet.text(x + kCellWidth / 2, y + kCellHeight / 2 + 5, figures.of(error(o)), 13, "middle",
               figures::ink_on(colour));
  }
  for (std::size_t t = 0; t < kTaus.size(); ++t) {
    sheet.text(x0 - 6, y0 + (static_cast<double>(t) + 0.62) * kCellHeight, fmt::format("τ = {}", kTaus[t]),
               12, "end");
  }
  for (std::size_t k = 0; k < kInfluences.size(); ++k) {
    sheet.text(x0 + (static_cast<double>(k) + 0.5) * kCellWidth, y0 + kMatrixHeight + 16,
               fmt::format("k = {}", kInfluences[k]), 12, "middle");
  }
}

void add_column(figures::Sheet& sheet, int column, std::string_view title,
                const std::vector<Outcome>& outcomes, const ErrorOf& error, const Figures& figures) {
  const double x = kLeft + column * (kLeft + kMatrixWidth + kGap);
  const auto [least, most] =
      std::minmax_element(outcomes.begin(), outcomes.end(),
                          [&](const Outcome& a, const Outcome& b) { return error(a) < error(b); });
  const Scale scale{error(*least), error(*most)};
  sheet.text(x + kMatrixWidth / 2, 22, title, 15, "middle");
  double y = kTop;
  for (const int w : kWidths) {
    add_matrix(sheet, x, y, w, outcomes, error, scale, figures);
    y += kMatrixHeight + kBelow;
  }
  std::vector<figures::Sheet::Tick> ticks;
  for (const double at : {0.0, 0.25, 0.5, 0.75, 1.0}) ticks.push_back({at, figures.of(scale.value(at))});
  sheet.text(x, y - 20, fmt::format("{}, linear scale:", title), 12);
  sheet.colour_bar(x, y - 10, kMatrixWidth - 1, figures::error_colour, ticks);
}

}  // namespace

figures::Sheet error_matrices_sheet(const std::vector<Outcome>& outcomes) {
  figures::Sheet sheet(2 * (kLeft + kMatrixWidth + kGap) + kRight,
                       kTop + kWidths.size() * (kMatrixHeight + kBelow) + 34);
  add_column(sheet, 0, "RMSE ÷ range of elevations", outcomes, [](const Outcome& o) { return o.rmse; },
             {1, 4});
  add_column(sheet, 1, "1000 × AHD in plan ÷ diagonal", outcomes, [](const Outcome& o) { return o.ahd[0]; },
             {1000, 3});
  return sheet;
}

void draw_error_matrices(const Study& study, const std::vector<Outcome>& outcomes, Recorder& recorder) {
  // A cell of each matrix on the right, which prints it multiplied.
  for (const Outcome& o : outcomes) {
    if (o.setting.tau != kTaus.front() || o.setting.k != 20) continue;
    add_share(recorder, fmt::format("drawn_ahd_w_{}", o.setting.w), o.ahd[0]);
  }
  error_matrices_sheet(outcomes).write(recorder.figure(
      "drill.F4" + study.suffix,
      fmt::format(
          "Redrawn after the paper\'s figure 4: normalised errors of the 54 parameter sets on {}, {}. "
          "Left the RMSE, right the AHD (the mean in plan), with one matrix per width w. "
          "Colours are linear, from the least of each metric (blue) to the largest (red).",
          study.name, study.variant.words)));
}

}  // namespace terrabench::drill
