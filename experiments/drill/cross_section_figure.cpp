// Figure 2: the cross-sections of one channel pixel, their union and the shapes fitted to it.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "experiments/drill/cutting_planes.h"
#include "experiments/drill/figures.h"
#include "experiments/figures/maps.h"
#include "representations/drill/cross_sections.h"
#include "representations/drill/profile_fit.h"
#include "terrain/hydrology/channels.h"

namespace terrabench::drill {
namespace {

constexpr int kW = 20, kAround = kW + CuttingPlanes::kMargin;
constexpr double kSide = 420, kTop = 44, kLeft = 24;
constexpr Rgb kInk{0, 0, 0}, kGrid{225, 225, 225}, kMonotone{224, 0, 110}, kPrinted{0, 120, 60},
    kVertex{0, 70, 200};

// The left half: the block of ground, cut by planes.
void draw_planes(figures::Sheet& sheet, const Heightfield& ground, std::uint32_t pixel) {
  constexpr double kHigh = 392;
  const CuttingPlanes planes(ground, pixel, kW);
  sheet.picture(kLeft, kTop, kSide, kHigh,
                planes.draw(static_cast<int>(kSide) * figures::Sheet::kPixels,
                            static_cast<int>(kHigh) * figures::Sheet::kPixels));
  const double cell = std::sqrt(static_cast<double>(ground.cell_x) * ground.cell_z);
  sheet.text(kLeft, kTop + kHigh + 18,
             fmt::format("seen from the south-south-west; heights stretched {:.1f} times",
                         cell / planes.metres_per_sample()),
             12);
}

// 1, 2 or 5 times a power of ten: about six steps cover the span.
double round_step(double span) {
  const double step = span / 6, power = std::pow(10, std::floor(std::log10(step)));
  return power * (step <= power ? 1 : step <= 2 * power ? 2 : step <= 5 * power ? 5 : 10);
}

// The right half: height against distance.
class ProfileChart {
 public:
  ProfileChart(figures::Sheet& sheet, double low, double high) : sheet_(sheet) {
    const double step = round_step(std::max(high - low, 1.0));
    low_ = step * std::floor(low / step);
    high_ = step * std::ceil(high / step);
    for (double level = low_; level <= high_ + step / 2; level += step) {
      sheet.line(std::array{at(0, level), at(kW, level)}, {.colour = kGrid});
      sheet.text(kX - 6, at(0, level).y + 4, fmt::format("{:g}", level), 12, "end");
    }
    for (int distance = 0; distance <= kW; distance += 5) {
      const figures::SheetPoint foot = at(distance, low_);
      sheet.line(std::array{foot, figures::SheetPoint{foot.x, foot.y + 4}}, {.colour = kInk});
      sheet.text(foot.x, foot.y + 18, fmt::format("{}", distance), 12, "middle");
    }
    sheet.panel(kX, kTop, kWidth, kHeight);
    sheet.line(std::array{at(0, high_), at(0, low_), at(kW, low_)}, {.colour = kInk});
    sheet.text(kX + kWidth / 2, kTop + kHeight + 38, "distance from the pixel, samples", 13, "middle");
    sheet.text(kX - 40, kTop - 12, "(b) elevation, m", 13);
  }
  figures::SheetPoint at(double distance, double level) const {
    return {kX + kWidth * distance / kW, kTop + kHeight * (high_ - level) / (high_ - low_)};
  }
  template <class LevelOf>
  void curve(const LevelOf& level, const figures::Stroke& stroke) {
    std::vector<figures::SheetPoint> points;
    for (int i = 0; i <= kW; ++i) {
      if (level(i) > high_) {  // a fitted curve that leaves the chart is cut at the upper border
        if (i > 0) points.push_back(at(i - (level(i) - high_) / (level(i) - level(i - 1)), high_));
        break;
      }
      points.push_back(at(i, level(i)));
    }
    sheet_.line(points, stroke);
  }
  // An entry of the key below the chart, level with the left panel's legend.
  void key(double x, std::string_view words, const figures::Stroke& stroke, int row = 0) {
    const double y = kTop + kHeight + 62 + 20 * row;
    sheet_.line(std::array{figures::SheetPoint{kX + x, y}, figures::SheetPoint{kX + x + 34, y}}, stroke);
    sheet_.text(kX + x + 40, y + 4, words, 12);
  }

 private:
  static constexpr double kX = 520, kWidth = 440, kHeight = 392;

  figures::Sheet& sheet_;
  double low_ = 0, high_ = 1;
};

}  // namespace

// A pixel in a clear valley, 0 if there is none: among the pixels at least kAround from the border and with a
// flow of at least 200 pixels, the one whose rays rise most on average.
std::uint32_t example_pixel(const Study& study) {
  const CrossSections sections(study.ground, kW);
  std::vector<float> rays(static_cast<std::size_t>(CrossSections::kRays) * kW);
  std::uint32_t best = 0;
  float most = -std::numeric_limits<float>::infinity();
  for (const std::uint32_t pixel : channel_pixels(study.network, 200)) {
    const int i = static_cast<int>(pixel) % study.ground.width,
              j = static_cast<int>(pixel) / study.ground.width;
    if (i < kAround || j < kAround || i >= study.ground.width - kAround ||
        j >= study.ground.depth - kAround) {
      continue;
    }
    sections.rays(pixel, rays);
    float rise = 0;
    for (const float h : rays) rise += h - study.ground.heights[pixel];
    if (rise > most) {
      most = rise;
      best = pixel;
    }
  }
  return best;
}

figures::Sheet cross_sections_sheet(const Study& study, std::uint32_t pixel) {
  const Heightfield& ground = study.ground;
  const CrossSections sections(ground, kW);
  std::vector<float> rays(static_cast<std::size_t>(CrossSections::kRays) * kW), joined(kW);
  sections.rays(pixel, rays);
  sections.join(pixel, joined);

  figures::Sheet sheet(984, 540);
  sheet.keep_all_colours();
  sheet.text(kLeft, kTop - 12,
             fmt::format("(a) planes of cross-sections, every tenth of {}, w = {}", CrossSections::kRays, kW),
             13);
  static_assert(CrossSections::kRays == 10 * CuttingPlanes::kPlanes);
  draw_planes(sheet, ground, pixel);

  const float floor = ground.heights[pixel];
  float low = floor, high = floor;
  for (const float h : rays) {
    if (!CrossSections::is_sample(h)) continue;
    low = std::min(low, h);
    high = std::max(high, h);
  }
  ProfileChart chart(sheet, low, high);
  for (int m = 0; m < CrossSections::kRays; ++m) {
    const float* const ray = rays.data() + static_cast<std::ptrdiff_t>(m) * kW;
    const double turn = static_cast<double>(m) / CrossSections::kRays;
    chart.curve([&](int r) { return r == 0 ? floor : ray[r - 1]; },
                {.colour = figures::direction_colour(turn), .thickness = 0.8, .opacity = 0.85});
  }
  const auto fitted = [&](DrillFit to) {
    const FittedProfile fit = fit_profile(joined, floor, to);
    return [=](int r) { return floor + fit.slope * r + fit.curvature * r * r; };
  };
  const figures::Stroke single{.colour = figures::direction_colour(0), .thickness = 1.2},
      joint{.colour = kInk, .thickness = 4}, dashed{.colour = kMonotone, .thickness = 2.5, .dashes = "9,5"},
      dotted{.colour = kPrinted, .thickness = 2.5, .dashes = "2,4"},
      mixed{.colour = kVertex, .thickness = 2.5, .dashes = "9,4,2,4"};
  chart.curve([&](int r) { return r == 0 ? floor : joined[static_cast<std::size_t>(r) - 1]; }, joint);
  chart.curve(fitted(DrillFit::kPrinted), dotted);
  chart.curve(fitted(DrillFit::kMonotone), dashed);
  chart.curve(fitted(DrillFit::kVertex), mixed);
  chart.key(-36, "a cross-section", single);
  chart.key(104, "their union", joint);
  chart.key(214, "fit as printed", dotted);
  chart.key(344, "monotone", dashed);
  chart.key(214, "vertex at the pixel", mixed, 1);
  return sheet;
}

void draw_cross_sections(const Study& study, Recorder& recorder) {
  if (std::min(study.ground.width, study.ground.depth) <= 2 * kAround) return;
  const std::uint32_t pixel = example_pixel(study);
  if (pixel == 0) return;  // no channel runs far enough from the border
  cross_sections_sheet(study, pixel)
      .write(recorder.figure(
          "drill.F2" + study.suffix, "png",
          fmt::format(
              "The paper's figure 2: planes of the {} cross-sections at one channel pixel of {} (a), every "
              "tenth drawn, and the elevations along all of them (b), coloured by direction, with "
              "their union and the three fits to it.",
              CrossSections::kRays, study.name)));
}

}  // namespace terrabench::drill
