#include "experiments/drill/figures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "experiments/drill/sheet.h"
#include "representations/drill/cross_sections.h"
#include "representations/drill/profile_fit.h"
#include "representations/drill/regenerate.h"

namespace terrabench::drill {
namespace {

constexpr double kGap = 16, kLine = 24;
constexpr Rgb kWater{20, 60, 200}, kRay{200, 30, 30}, kInk{0, 0, 0};

Image relief_of(const Heightfield& field, const HeightRange& range) {
  return relief(field, range.lowest, range.highest);
}

Heightfield regenerated(const Study& study, const Setting& setting) {
  DrillOptions options;
  options.tau = setting.tau;
  options.w = setting.w;
  options.k = setting.k;
  return regenerate(extract_drills(study.ground, study.network, options));
}

// Height of a panel so wide that shows the ground without distortion.
double panel_height(const Heightfield& field, double width) {
  return width * field.depth * field.cell_z / (field.width * field.cell_x);
}

// A pixel whose surroundings show a valley: of those with room for w all around and a flow of at least 200
// pixels, that from which the rays rise most, on average.
std::uint32_t example_pixel(const Study& study, const CrossSections& sections) {
  const int w = sections.w();
  std::vector<float> rays(static_cast<std::size_t>(CrossSections::kRays) * static_cast<std::size_t>(w));
  std::uint32_t best = 0;
  float most = -std::numeric_limits<float>::infinity();
  for (const std::uint32_t pixel : channel_pixels(study.network, 200)) {
    const int i = static_cast<int>(pixel) % study.ground.width,
              j = static_cast<int>(pixel) / study.ground.width;
    if (i < w || j < w || i >= study.ground.width - w || j >= study.ground.depth - w) continue;
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

// The right half of figure 2: height against distance.
class ProfileChart {
 public:
  ProfileChart(Sheet& sheet, double x, double y, double width, double height, double reach, double low,
               double high)
      : sheet_(sheet), x_(x), y_(y), width_(width), height_(height), reach_(reach), low_(low), high_(high) {
    sheet.line(std::array{SheetPoint{x, y}, SheetPoint{x, y + height}, SheetPoint{x + width, y + height}},
               kInk, 1);
    for (int tick = 0; tick <= 4; ++tick) {
      const double distance = reach * tick / 4, level = low + (high - low) * tick / 4;
      sheet.text(at(distance, low).x, y + height + 18, fmt::format("{:g}", distance), 12, "middle");
      sheet.text(x - 6, at(0, level).y + 4, fmt::format("{:.0f}", level), 12, "end");
    }
    sheet.text(x + width / 2, y + height + 38, "distance from the pixel, samples", 13, "middle");
    sheet.text(x - 6, y - 10, "elevation, m", 13);
  }
  SheetPoint at(double distance, double level) const {
    return {x_ + width_ * distance / reach_, y_ + height_ * (high_ - level) / (high_ - low_)};
  }
  template <class LevelOf>
  void curve(const LevelOf& level, Rgb colour, double thickness, double opacity) {
    std::vector<SheetPoint> points;
    for (int i = 0; i <= static_cast<int>(reach_); ++i) {
      if (level(i) > high_) {  // a fitted curve may leave the chart: it ends at the upper border
        if (i > 0) points.push_back(at(i - (level(i) - high_) / (level(i) - level(i - 1)), high_));
        break;
      }
      points.push_back(at(i, level(i)));
    }
    sheet_.line(points, colour, thickness, opacity);
  }

 private:
  Sheet& sheet_;
  double x_, y_, width_, height_, reach_, low_, high_;
};

// Metres above (red) and below (blue) the ground, over its shading.
Image difference_map(const Heightfield& ground, const Heightfield& other, double most) {
  Image image = relief(ground, 0, 0);
  for (int j = 0; j < ground.depth; ++j) {
    for (int i = 0; i < ground.width; ++i) {
      const double difference = static_cast<double>(other.at(i, j)) - ground.at(i, j);
      if (std::isnan(difference)) continue;
      const Rgb tint = error_colour(0.5 + 0.5 * difference / most), shade = image.pixel(i, j);
      Rgb colour;
      for (int c = 0; c < 3; ++c) colour[c] = static_cast<std::uint8_t>(tint[c] * shade[c] / 255);
      image.set(i, j, colour);
    }
  }
  return image;
}

}  // namespace

void draw_channels(const Study& study, Recorder& recorder) {
  const double width = 400, height = panel_height(study.ground, width);
  Sheet sheet(static_cast<int>(2 * width + 3 * kGap), static_cast<int>(2 * (height + kLine + kGap) + kGap));
  const HeightRange range = height_range(study.ground);
  int panel = 0;
  for (const std::uint32_t tau : {25U, 50U, 100U, 200U}) {
    Image image = relief_of(study.ground, range);
    const auto channels = channel_pixels(study.network, tau);
    for (const std::uint32_t pixel : channels) {
      image.set(static_cast<int>(pixel) % image.width, static_cast<int>(pixel) / image.width, kWater);
    }
    const double x = kGap + (panel % 2) * (width + kGap), y = kGap + (panel / 2) * (height + kLine + kGap);
    sheet.picture(x, y, width, height, image);
    sheet.text(x + width / 2, y + height + 17, fmt::format("τ = {} ({} pixels)", tau, channels.size()), 14,
               "middle");
    ++panel;
  }
  sheet.write(
      recorder.figure("drill.F1" + study.suffix, "png",
                      fmt::format("Channel networks at four thresholds over the relief: {} × {} "
                                  "samples, {:.0f} to {:.0f} m, blue to white",
                                  study.ground.width, study.ground.depth, range.lowest, range.highest)));
}

void draw_cross_sections(const Study& study, Recorder& recorder) {
  constexpr int kW = 20;
  if (std::min(study.ground.width, study.ground.depth) <= 2 * kW) return;
  const CrossSections sections(study.ground, kW);
  const std::uint32_t pixel = example_pixel(study, sections);
  std::vector<float> rays(static_cast<std::size_t>(CrossSections::kRays) * kW), joined(kW);
  sections.rays(pixel, rays);
  sections.join(pixel, joined);
  const int i = static_cast<int>(pixel) % study.ground.width,
            j = static_cast<int>(pixel) / study.ground.width;
  const int i0 = std::clamp(i - kW - 4, 0, std::max(0, study.ground.width - 2 * kW - 9));
  const int j0 = std::clamp(j - kW - 4, 0, std::max(0, study.ground.depth - 2 * kW - 9));
  const Heightfield around = crop(study.ground, i0, j0, std::min(2 * kW + 9, study.ground.width - i0),
                                  std::min(2 * kW + 9, study.ground.depth - j0));
  const double side = 440, scale = side / around.width;
  Sheet sheet(1040, 540);
  sheet.picture(kGap, kGap + kLine, side, scale * around.depth, relief_of(around, height_range(around)));
  const SheetPoint centre{kGap + (i - i0 + 0.5) * scale, kGap + kLine + (j - j0 + 0.5) * scale};
  for (int m = 0; m < CrossSections::kRays; ++m) {
    const double angle = 2 * std::numbers::pi * m / CrossSections::kRays;
    sheet.line(std::array{centre, SheetPoint{centre.x + kW * scale * std::cos(angle),
                                             centre.y + kW * scale * std::sin(angle)}},
               kRay, 0.8, 0.7);
  }
  const float floor = study.ground.heights[pixel];
  float low = floor, high = floor;
  for (const float h : rays) {
    if (!CrossSections::is_sample(h)) continue;
    low = std::min(low, h);
    high = std::max(high, h);
  }
  ProfileChart chart(sheet, 560, kGap + kLine + 16, 450, 400, kW, low, high);
  for (int m = 0; m < CrossSections::kRays; ++m) {
    const float* const ray = rays.data() + static_cast<std::ptrdiff_t>(m) * kW;
    chart.curve([&](int r) { return r == 0 ? floor : ray[r - 1]; }, error_colour(m / 119.0), 0.8, 0.8);
  }
  chart.curve([&](int r) { return r == 0 ? floor : joined[static_cast<std::size_t>(r) - 1]; }, kInk, 4, 1);
  const Profile fit = fit_profile(joined, floor, kRisesEverywhere);
  chart.curve([&](int r) { return floor + fit.slope * r + fit.curvature * r * r; }, {20, 140, 60}, 2.5, 1);
  sheet.write(recorder.figure(
      "drill.F2" + study.suffix, "png",
      fmt::format("Left, the {} cross-sections at one channel pixel, seen from above, w = {}; right, their "
                  "elevations (thin), the union (black) and the fitted quadratic (green)",
                  CrossSections::kRays, kW)));
}

void draw_best(const Study& study, const Outcome& least_rmse, const Outcome& least_ahd, Recorder& recorder) {
  const double width = 440, height = panel_height(study.ground, width);
  const HeightRange range = height_range(study.ground);
  const Heightfield terrains[] = {regenerated(study, least_rmse.setting),
                                  regenerated(study, least_ahd.setting)};
  Sheet sheet(static_cast<int>(2 * width + 3 * kGap), static_cast<int>(height + kLine + 2 * kGap));
  Sheet maps = sheet;
  const double most = 4 * least_rmse.rmse_metres;
  for (int panel = 0; panel < 2; ++panel) {
    const Outcome& outcome = panel == 0 ? least_rmse : least_ahd;
    const double x = kGap + panel * (width + kGap);
    const std::string label =
        fmt::format("{}: τ = {}, w = {}, k = {}; RMSE {:.4f}, AHD {:.5f}", panel == 0 ? "RMSE" : "AHD",
                    outcome.setting.tau, outcome.setting.w, outcome.setting.k, outcome.rmse, outcome.ahd[0]);
    sheet.picture(x, kGap, width, height, relief_of(terrains[panel], range));
    maps.picture(x, kGap, width, height, difference_map(study.ground, terrains[panel], most));
    for (Sheet* s : {&sheet, &maps}) s->text(x + width / 2, kGap + height + 17, label, 13, "middle");
  }
  sheet.write(
      recorder.figure("drill.F3" + study.suffix, "png",
                      "Regenerated terrain with the lowest RMSE (left) and with the lowest AHD, taken "
                      "along the map (right); colours of figure 1"));
  maps.write(
      recorder.figure("drill.difference" + study.suffix, "png",
                      fmt::format("The same two terrains minus the original over its shading: blue {:.0f} m "
                                  "too low, red {:.0f} m too high",
                                  most, most)));
}

void draw_matrices(const Study& study, const std::vector<Outcome>& outcomes, Recorder& recorder) {
  const double cell_width = 74, cell_height = 40, left = 90, top = 56;
  const double matrix_width = cell_width * kInfluences.size(), matrix_height = cell_height * kTaus.size();
  const double step_x = matrix_width + left + kGap, step_y = matrix_height + 64;
  Sheet sheet(static_cast<int>(2 * step_x + kGap), static_cast<int>(top + 3 * step_y));
  for (int column = 0; column < 2; ++column) {
    const auto error = [&](const Outcome& o) { return column == 0 ? o.rmse : o.ahd[0]; };
    const auto [least, most] =
        std::minmax_element(outcomes.begin(), outcomes.end(),
                            [&](const Outcome& a, const Outcome& b) { return error(a) < error(b); });
    const double low = error(*least), span = std::max(error(*most) - low, 1e-12);
    const double x0 = left + column * step_x;
    sheet.text(x0 + matrix_width / 2, 24, column == 0 ? "RMSE" : "AHD", 18, "middle");
    for (std::size_t row = 0; row < kWidths.size(); ++row) {
      const double y0 = top + static_cast<double>(row) * step_y;
      sheet.text(x0, y0 - 8, fmt::format("w = {}", kWidths[row]), 14);
      for (const Outcome& o : outcomes) {
        if (o.setting.w != kWidths[row]) continue;
        const auto k = std::find(kInfluences.begin(), kInfluences.end(), o.setting.k) - kInfluences.begin();
        const auto t = std::find(kTaus.begin(), kTaus.end(), o.setting.tau) - kTaus.begin();
        const double x = x0 + static_cast<double>(k) * cell_width,
                     y = y0 + static_cast<double>(t) * cell_height;
        sheet.box(x, y, cell_width - 1, cell_height - 1, error_colour((error(o) - low) / span));
        const double share = (error(o) - low) / span;
        sheet.text(x + cell_width / 2, y + cell_height / 2 + 5,
                   fmt::format("{:.{}f}", error(o), column == 0 ? 4 : 5), 13, "middle",
                   share < 0.2 || share > 0.85 ? Rgb{255, 255, 255} : kInk);
      }
      for (std::size_t t = 0; t < kTaus.size(); ++t) {
        sheet.text(x0 - 6, y0 + (static_cast<double>(t) + 0.6) * cell_height, fmt::format("τ = {}", kTaus[t]),
                   13, "end");
      }
      for (std::size_t k = 0; k < kInfluences.size(); ++k) {
        sheet.text(x0 + (static_cast<double>(k) + 0.5) * cell_width, y0 + matrix_height + 18,
                   fmt::format("k = {}", kInfluences[k]), 13, "middle");
      }
    }
  }
  sheet.write(
      recorder.figure("drill.F4" + study.suffix, "png",
                      "Error of the 54 parameter sets, normalised: RMSE left, AHD along the map right, one "
                      "row a width w; from the least (blue) to the largest (red) of each metric"));
}

}  // namespace terrabench::drill
