// Figure 2: the cross-sections of one channel pixel, their union and the shape fitted to it.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "experiments/drill/figures.h"
#include "experiments/figures/maps.h"
#include "representations/drill/cross_sections.h"
#include "representations/drill/profile_fit.h"
#include "terrain/hydrology/channels.h"

namespace terrabench::drill {
namespace {

constexpr int kW = 20;
constexpr double kSide = 420, kTop = 44, kLeft = 24;
constexpr Rgb kInk{0, 0, 0}, kGrid{225, 225, 225}, kFit{224, 0, 110}, kPrintedFit{0, 120, 60};

// The ground around the pixel seen from above, with the rays drawn on it.
void draw_rays(figures::Sheet& sheet, const Heightfield& ground, int i, int j) {
  constexpr int kAround = kW + 4;
  const int i0 = std::clamp(i - kAround, 0, std::max(0, ground.width - 2 * kAround - 1));
  const int j0 = std::clamp(j - kAround, 0, std::max(0, ground.depth - 2 * kAround - 1));
  const Heightfield around = crop(ground, i0, j0, std::min(2 * kAround + 1, ground.width - i0),
                                  std::min(2 * kAround + 1, ground.depth - j0));
  const HeightRange range = height_range(around);
  // One square per sample, since distances count in samples; pale, so that the rays stand out.
  const float span = std::max(range.highest - range.lowest, 1e-6F);
  const auto pale = [&](double t) {
    Rgb colour = figures::elevation_colour(t);
    for (std::uint8_t& c : colour) c = static_cast<std::uint8_t>((c + 255) / 2);
    return colour;
  };
  const Image image = figures::shaded_map(
      around, figures::Light(around), [&](float h) { return pale((h - range.lowest) / span); }, 0.4, 0.5);
  const double scale = kSide / around.width;
  sheet.picture(kLeft, kTop, kSide, scale * around.depth, image);
  const figures::SheetPoint centre{kLeft + (i - i0 + 0.5) * scale, kTop + (j - j0 + 0.5) * scale};
  for (int m = 0; m < CrossSections::kRays; ++m) {
    const double turn = static_cast<double>(m) / CrossSections::kRays, angle = 2 * std::numbers::pi * turn;
    sheet.line(std::array{centre, figures::SheetPoint{centre.x + kW * scale * std::cos(angle),
                                                      centre.y + kW * scale * std::sin(angle)}},
               {.colour = figures::direction_colour(turn), .thickness = 1.2});
  }
  figures::add_colour_key(sheet, kLeft, kTop + scale * around.depth + 14, "elevation, m", 110, 180, pale,
                          {fmt::format("{:.0f}", range.lowest), fmt::format("{:.0f}", range.highest)});
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
  void key(double x, std::string_view words, const figures::Stroke& stroke) {
    const double y = kTop + kHeight + 62;
    sheet_.line(std::array{figures::SheetPoint{kX + x, y}, figures::SheetPoint{kX + x + 34, y}}, stroke);
    sheet_.text(kX + x + 40, y + 4, words, 12);
  }

 private:
  static constexpr double kX = 520, kWidth = 440, kHeight = 392;

  figures::Sheet& sheet_;
  double low_ = 0, high_ = 1;
};

}  // namespace

// A pixel in a clear valley: among the pixels at least w from the border and with a flow of at least 200
// pixels, the one whose rays rise most on average.
std::uint32_t example_pixel(const Study& study) {
  const CrossSections sections(study.ground, kW);
  std::vector<float> rays(static_cast<std::size_t>(CrossSections::kRays) * kW);
  std::uint32_t best = 0;
  float most = -std::numeric_limits<float>::infinity();
  for (const std::uint32_t pixel : channel_pixels(study.network, 200)) {
    const int i = static_cast<int>(pixel) % study.ground.width,
              j = static_cast<int>(pixel) / study.ground.width;
    if (i < kW || j < kW || i >= study.ground.width - kW || j >= study.ground.depth - kW) continue;
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

  figures::Sheet sheet(984, 522);
  sheet.text(kLeft, kTop - 12,
             fmt::format("(a) {} cross-sections from above, w = {}, north up", CrossSections::kRays, kW), 13);
  draw_rays(sheet, ground, static_cast<int>(pixel) % ground.width, static_cast<int>(pixel) / ground.width);

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
  const auto fitted = [&](double rises_to) {
    const FittedProfile fit = fit_profile(joined, floor, rises_to);
    return [=](int r) { return floor + fit.slope * r + fit.curvature * r * r; };
  };
  const figures::Stroke single{.colour = figures::direction_colour(0), .thickness = 1.2},
      joint{.colour = kInk, .thickness = 4}, dashed{.colour = kFit, .thickness = 2.5, .dashes = "9,5"},
      dotted{.colour = kPrintedFit, .thickness = 2.5, .dashes = "2,4"};
  chart.curve([&](int r) { return r == 0 ? floor : joined[static_cast<std::size_t>(r) - 1]; }, joint);
  chart.curve(fitted(kRisesEverywhere), dashed);
  chart.curve(fitted(kRisesNowhere), dotted);
  chart.key(-120, "a cross-section", single);
  chart.key(30, "their union", joint);
  chart.key(160, "fit, monotone", dashed);
  chart.key(300, "fit as printed", dotted);
  return sheet;
}

void draw_cross_sections(const Study& study, Recorder& recorder) {
  if (std::min(study.ground.width, study.ground.depth) <= 2 * kW) return;
  cross_sections_sheet(study, example_pixel(study))
      .write(recorder.figure(
          "drill.F2" + study.suffix, "png",
          fmt::format("The paper's figure 2: the {} cross-sections at one channel pixel of {} (a), and their "
                      "elevations in the same colours (b), with the union, which is the highest at each "
                      "distance, and the quadratics fitted to it: monotone, and as printed in §2.2",
                      CrossSections::kRays, study.name)));
}

}  // namespace terrabench::drill
