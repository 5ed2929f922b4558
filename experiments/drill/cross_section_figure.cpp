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

// What the right half shows: at distances 1 to kW, the cross-sections of a pixel, their union and its fits.
struct Profiles {
  float floor = 0;  // the pixel's elevation, where all curves begin
  std::vector<float> rays = std::vector<float>(static_cast<std::size_t>(CrossSections::kRays) * kW);
  std::vector<float> joined = std::vector<float>(kW);
  std::array<FittedProfile, kFits.size()> fits;

  Profiles(const Heightfield& ground, std::uint32_t pixel) : floor(ground.heights[pixel]) {
    const CrossSections sections(ground, kW);
    sections.rays(pixel, rays);
    sections.join(pixel, joined);
    for (std::size_t f = 0; f < fits.size(); ++f) fits[f] = fit_profile(joined, floor, kFits[f].fit);
  }
  float ray(int m, int r) const { return r == 0 ? floor : rays[static_cast<std::size_t>(m) * kW + r - 1]; }
  float united(int r) const { return r == 0 ? floor : joined[static_cast<std::size_t>(r) - 1]; }
  double fitted(std::size_t fit, int r) const {
    return floor + fits[fit].slope * r + fits[fit].curvature * r * r;
  }
};

// Records measures that reach the expected values only if the curve is the union of the pixel's
// cross-sections and the fits are least-squares fits.
void record_profiles(const Profiles& shown, const Heightfield& ground, std::uint32_t pixel,
                     Recorder& recorder) {
  constexpr float kRounding = 1e-3F;  // metres: weights of bilinear samples are rounded
  const int i = static_cast<int>(pixel) % ground.width, j = static_cast<int>(pixel) / ground.width;
  int above = 0, met = 0, off_ground = 0;
  for (int r = 1; r <= kW; ++r) {
    bool on_a_section = false;
    for (int m = 0; m < CrossSections::kRays; ++m) {
      above += shown.ray(m, r) > shown.united(r);
      on_a_section = on_a_section || shown.ray(m, r) == shown.united(r);
    }
    met += on_a_section;
    // Four of the rays run along rows and columns of samples; no ray sees further than one sample past r.
    const float on_axes =
        std::max({ground.at(i - r, j), ground.at(i + r, j), ground.at(i, j - r), ground.at(i, j + r)});
    const HeightRange near = height_range(crop(ground, i - r - 1, j - r - 1, 2 * r + 3, 2 * r + 3));
    off_ground += on_axes > shown.united(r) + kRounding || shown.united(r) > near.highest + kRounding;
  }
  recorder.add("drawn_sections_above_union", "", above);
  recorder.add("drawn_union_on_sections", "", met);
  recorder.add("drawn_union_off_ground", "", off_ground);
  const auto record_error = [&](std::string_view of, const auto& level) {
    double squares = 0;
    for (int r = 1; r <= kW; ++r) squares += std::pow(level(r) - shown.united(r), 2);
    recorder.add(fmt::format("drawn_rms_{}", of), "m", std::sqrt(squares / kW));
  };
  for (std::size_t f = 0; f < kFits.size(); ++f) {
    record_error(kFits[f].name, [&](int r) { return shown.fitted(f, r); });
  }
  record_error("level", [&](int) { return shown.floor; });
}

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

// The planes and cross-sections of one channel pixel, their union and the fits.
figures::Sheet cross_sections_sheet(const Study& study, std::uint32_t pixel) {
  const Heightfield& ground = study.ground;
  const Profiles shown(ground, pixel);
  figures::Sheet sheet(984, 540);
  sheet.text(kLeft, kTop - 12,
             fmt::format("(a) planes of cross-sections, every tenth of {}, w = {}", CrossSections::kRays, kW),
             13);
  static_assert(CrossSections::kRays == 10 * CuttingPlanes::kPlanes);
  draw_planes(sheet, ground, pixel);

  float low = shown.floor, high = shown.floor;
  for (const float h : shown.rays) {
    if (!CrossSections::is_sample(h)) continue;
    low = std::min(low, h);
    high = std::max(high, h);
  }
  ProfileChart chart(sheet, low, high);
  for (int m = 0; m < CrossSections::kRays; ++m) {
    const double turn = static_cast<double>(m) / CrossSections::kRays;
    chart.curve([&](int r) { return shown.ray(m, r); },
                {.colour = figures::direction_colour(turn), .thickness = 0.8, .opacity = 0.85});
  }
  const figures::Stroke single{.colour = figures::direction_colour(0), .thickness = 1.2},
      joint{.colour = kInk, .thickness = 4};
  const std::array<figures::Stroke, kFits.size()> strokes{
      {{.colour = kPrinted, .thickness = 2.5, .dashes = "2,4"},
       {.colour = kMonotone, .thickness = 2.5, .dashes = "9,5"},
       {.colour = kVertex, .thickness = 2.5, .dashes = "9,4,2,4"}}};
  chart.curve([&](int r) { return shown.united(r); }, joint);
  for (std::size_t f = 0; f < strokes.size(); ++f) {
    chart.curve([&](int r) { return shown.fitted(f, r); }, strokes[f]);
  }
  chart.key(-36, "a cross-section", single);
  chart.key(124, "their union", joint);
  chart.key(-36, "fit as printed", strokes[0], 1);
  chart.key(124, "monotone fit", strokes[1], 1);
  chart.key(276, "vertex at the pixel", strokes[2], 1);
  return sheet;
}

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

void draw_cross_sections(const Study& study, Recorder& recorder) {
  if (std::min(study.ground.width, study.ground.depth) <= 2 * kAround) return;
  const std::uint32_t pixel = example_pixel(study);
  if (pixel == 0) return;  // no channel runs far enough from the border
  record_profiles(Profiles(study.ground, pixel), study.ground, pixel, recorder);
  cross_sections_sheet(study, pixel)
      .write(recorder.figure(
          "drill.F2" + study.suffix,
          fmt::format("Redrawn after the paper\'s figure 2, at one channel pixel of {}: (a) every tenth "
                      "plane of the {} "
                      "cross-sections, (b) the elevations along all of them, coloured by direction, "
                      "with their union and the three fits to it.",
                      study.name, CrossSections::kRays)));
}

}  // namespace terrabench::drill
