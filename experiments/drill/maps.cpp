// Figures 1 and 3, and what regeneration changes: the ground seen from above.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "experiments/drill/colours.h"
#include "experiments/drill/figures.h"
#include "experiments/drill/sheet.h"
#include "representations/drill/extract.h"
#include "representations/drill/regenerate.h"
#include "results/format.h"
#include "terrain/hydrology/channels.h"

namespace terrabench::drill {
namespace {

constexpr double kGap = 16, kTitle = 26, kLegend = 48;
constexpr double kPanel = 400;  // about as wide
constexpr Rgb kInk{32, 32, 32};

// A panel of square pixels that shows the ground without distortion, each sample at least one of them.
struct Panel {
  int columns, rows;
  double width, height;  // units

  explicit Panel(const Heightfield& ground) {
    constexpr double kMost = kPanel * Sheet::kPixels;
    columns = std::min(ground.width, static_cast<int>(kMost));
    const double aspect =
        (static_cast<double>(ground.depth) * ground.cell_z) / (ground.width * ground.cell_x);
    rows = std::clamp(static_cast<int>(std::lround(columns * aspect)), 1, 4 * columns);
    const double pixel = std::max(1.0, std::round(kMost / columns)) / Sheet::kPixels;
    width = pixel * columns;
    height = pixel * rows;
  }
  Heightfield fitted(const Heightfield& field) const {
    return field.width == columns && field.depth == rows ? field : resample(field, columns, rows);
  }
};

// Two panels beside each other, `rows` such rows, and a legend below.
struct Layout {
  Panel panel;
  int rows;
  double width() const { return 2 * panel.width + 3 * kGap; }
  double x(int number) const { return kGap + (number % 2) * (panel.width + kGap); }
  double y(int number) const { return kTitle + (number / 2) * (panel.height + kGap + kTitle); }
  double legend() const { return y(2 * rows - 1) + panel.height + kGap; }
  double height() const { return legend() + kLegend; }

  Sheet sheet() const { return {width(), height()}; }
  void place(Sheet& sheet, int number, std::string_view title, const Image& image) const {
    sheet.text(x(number), y(number) - 8, fmt::format("({:c}) {}", 'a' + number, title), 13);
    sheet.picture(x(number), y(number), panel.width, panel.height, image);
  }
};

template <class ColourOf>
Image shaded_map(const Heightfield& field, const Light& light, const ColourOf& colour) {
  Image image(field.width, field.depth, {255, 255, 255});
  for (int j = 0; j < field.depth; ++j) {
    for (int i = 0; i < field.width; ++i) {
      if (!Heightfield::is_no_data(field.at(i, j))) {
        image.set(i, j, lit(colour(field.at(i, j)), light.at(i, j)));
      }
    }
  }
  return image;
}

auto colour_between(const HeightRange& range) {
  return [range](float height) {
    const float span = range.highest - range.lowest;
    return elevation_colour(span > 0 ? (height - range.lowest) / span : 0);
  };
}

// The pixels of the image that hold a channel pixel, or lie in one where they are finer than samples.
void draw_channel_pixels(const std::vector<std::uint32_t>& channels, const Heightfield& ground,
                         Image& image) {
  std::vector<bool> is_channel(ground.heights.size());
  for (const std::uint32_t pixel : channels) {
    is_channel[pixel] = true;
    const std::size_t i = pixel % ground.width, j = pixel / ground.width;
    image.set(static_cast<int>(i * image.width / ground.width),
              static_cast<int>(j * image.height / ground.depth), kChannel);
  }
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const std::size_t i = static_cast<std::size_t>(x) * ground.width / image.width,
                        j = static_cast<std::size_t>(y) * ground.depth / image.height;
      if (is_channel[j * ground.width + i]) image.set(x, y, kChannel);
    }
  }
}

// A key in the legend; returns where the next begins.
double add_swatch(Sheet& sheet, double x, double y, Rgb colour, std::string_view words) {
  sheet.box(x, y, 22, 12, colour);
  sheet.text(x + 28, y + 11, words, 12);
  return x + 28 + 7.2 * static_cast<double>(words.size()) + kGap;
}

void add_elevations(Sheet& sheet, double x, double y, const HeightRange& range) {
  const double middle = (static_cast<double>(range.lowest) + range.highest) / 2;
  const Sheet::Tick ticks[] = {{0, fmt::format("{:.0f}", range.lowest)},
                               {0.5, fmt::format("{:.0f}", middle)},
                               {1, fmt::format("{:.0f}", range.highest)}};
  sheet.text(x, y + 11, "elevation, m", 12);
  sheet.colour_bar(x + 100, y, 180, elevation_colour, ticks);
}

// About a quarter of the panel, a round number of metres, ending at the panels' right border.
void add_scale(Sheet& sheet, const Layout& layout, const Heightfield& ground) {
  const double metres_a_unit = static_cast<double>(ground.width) * ground.cell_x / layout.panel.width;
  const double wish = layout.panel.width / 4 * metres_a_unit,
               power = std::pow(10, std::floor(std::log10(wish)));
  const double length = power * (wish >= 5 * power ? 5 : wish >= 2 * power ? 2 : 1);
  const double right = layout.width() - kGap, left = right - length / metres_a_unit, y = layout.legend() + 6;
  sheet.line(std::array{SheetPoint{left, y - 4}, SheetPoint{left, y + 4}, SheetPoint{left, y},
                        SheetPoint{right, y}, SheetPoint{right, y - 4}, SheetPoint{right, y + 4}},
             {.colour = kInk, .thickness = 1.5});
  const bool far = length >= 1000;
  sheet.text(right, y + 23, fmt::format("{:g} {}, north up", far ? length / 1000 : length, far ? "km" : "m"),
             12, "end");
}

Drills drills_of(const Study& study, const Setting& setting) {
  DrillOptions options;
  options.tau = setting.tau;
  options.w = setting.w;
  options.k = setting.k;
  return extract_drills(study.ground, study.network, options);
}

std::string title_of(std::string_view what, const Outcome& o) {
  return fmt::format("least {}: τ = {}, w = {}, k = {}", what, o.setting.tau, o.setting.w, o.setting.k);
}

Heightfield difference(const Heightfield& ground, const Heightfield& other) {
  Heightfield field = other;
  for (std::size_t i = 0; i < field.heights.size(); ++i) field.heights[i] -= ground.heights[i];
  return field;
}

// Over the ground's own shade, kept light so that the colours count.
Image difference_map(const Heightfield& metres, const Light& light, double most) {
  Image image(metres.width, metres.depth, {255, 255, 255});
  for (int j = 0; j < metres.depth; ++j) {
    for (int i = 0; i < metres.width; ++i) {
      const float m = metres.at(i, j);
      if (Heightfield::is_no_data(m)) continue;
      image.set(i, j, lit(difference_colour(0.5 + 0.5 * m / most), 0.45 + 0.4 * light.at(i, j)));
    }
  }
  return image;
}

}  // namespace

void draw_channels(const Study& study, Recorder& recorder) {
  const Layout layout{Panel(study.ground), 2};
  const HeightRange range = height_range(study.ground);
  const Heightfield fitted = layout.panel.fitted(study.ground);
  const Image relief = shaded_map(fitted, Light(fitted), colour_between(range));
  Sheet sheet = layout.sheet();
  int panel = 0;
  for (const std::uint32_t tau : {25U, 50U, 100U, 200U}) {
    const auto channels = channel_pixels(study.network, tau);
    Image image = relief;
    draw_channel_pixels(channels, study.ground, image);
    const auto count = static_cast<double>(channels.size());
    const double share = count / static_cast<double>(study.ground.heights.size() - range.no_data);
    layout.place(sheet, panel++,
                 fmt::format("τ = {}: {} channel pixels, {:.1f} %", tau, format_number(count), 100 * share),
                 image);
  }
  const double next = add_swatch(sheet, kGap, layout.legend(), kChannel, "channel");
  add_elevations(sheet, next, layout.legend(), range);
  add_scale(sheet, layout, study.ground);
  sheet.write(
      recorder.figure("drill.F1" + study.suffix, "png",
                      fmt::format("The paper's figure 1: channel networks at four thresholds τ over the "
                                  "shaded relief of {}, {} × {} samples. Each channel pixel is drawn.",
                                  study.name, study.ground.width, study.ground.depth)));
}

void draw_best(const Study& study, const Outcome& least_rmse, const Outcome& least_ahd, Recorder& recorder) {
  const Layout layout{Panel(study.ground), 1};
  const HeightRange range = height_range(study.ground);
  const Heightfield ground = layout.panel.fitted(study.ground);
  const Light light(ground);
  const double most = 4 * std::max(least_rmse.rmse_metres, 1e-3);
  Sheet sheet = layout.sheet(), maps = layout.sheet();
  for (int panel = 0; panel < 2; ++panel) {
    const Outcome& outcome = panel == 0 ? least_rmse : least_ahd;
    const Drills drills = drills_of(study, outcome.setting);
    const Heightfield regenerated = regenerate(drills), fitted = layout.panel.fitted(regenerated);
    const double untouched = static_cast<double>(count_untouched(drills, regenerated.heights)) /
                             static_cast<double>(regenerated.heights.size() - range.no_data);
    const auto elevations = colour_between(range);
    const std::string title = title_of(panel == 0 ? "RMSE" : "AHD", outcome);
    layout.place(sheet, panel, fmt::format("{}; {:.1f} % untouched", title, 100 * untouched),
                 shaded_map(fitted, Light(fitted, light), [&](float height) {
                   return is_touched(height, drills) ? elevations(height) : kUntouched;
                 }));
    layout.place(maps, panel, fmt::format("{}; RMSE {:.1f} m", title, outcome.rmse_metres),
                 difference_map(layout.panel.fitted(difference(study.ground, regenerated)), light, most));
  }
  const double next = add_swatch(sheet, kGap, layout.legend(), kUntouched, "no drill reaches");
  add_elevations(sheet, next, layout.legend(), range);
  add_scale(sheet, layout, study.ground);
  sheet.write(recorder.figure(
      "drill.F3" + study.suffix, "png",
      fmt::format(
          "The paper's figure 3: {} regenerated with the parameters of least RMSE (a) and of least AHD "
          "along the map (b). Where no drill reaches, the plateau is left.",
          study.name)));

  const Sheet::Tick ticks[] = {
      {0, fmt::format("−{:.0f} or less", most)}, {0.5, "0"}, {1, fmt::format("{:.0f} or more", most)}};
  maps.text(kGap, layout.legend() + 11, "regenerated minus original, m", 12);
  maps.colour_bar(kGap + 240, layout.legend(), 260, difference_colour, ticks);
  add_scale(maps, layout, study.ground);
  maps.write(recorder.figure(
      "drill.difference" + study.suffix, "png",
      fmt::format(
          "What figure 3's two terrains differ by from {}, over its shaded relief: blue too low, red too "
          "high",
          study.name)));
}

}  // namespace terrabench::drill
