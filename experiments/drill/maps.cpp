// Figures 1 and 3.
#include "experiments/figures/maps.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "experiments/drill/figures.h"
#include "representations/drill/extract.h"
#include "representations/drill/regenerate.h"
#include "results/store/format.h"
#include "terrain/hydrology/channels.h"

namespace terrabench::drill {
namespace {

constexpr double kGap = 16, kLegend = 48;  // units of the sheet, as all lengths here
constexpr double kPanel = 400;             // approximate width
constexpr Rgb kInk{32, 32, 32};

// Rows of two panels with square pixels, at least one sample per pixel, and a legend below.
struct Layout {
  int columns, rows;  // pixels of a panel
  figures::PanelGrid grid;

  Layout(const Heightfield& ground, int panel_rows) {
    constexpr double kMost = kPanel * figures::Sheet::kPixels;
    columns = std::min(ground.width, static_cast<int>(kMost));
    const double aspect =
        (static_cast<double>(ground.depth) * ground.cell_z) / (ground.width * ground.cell_x);
    rows = std::clamp(static_cast<int>(std::lround(columns * aspect)), 1, 4 * columns);
    const double pixel = std::max(1.0, std::round(kMost / columns)) / figures::Sheet::kPixels;
    grid = {.rows = panel_rows, .width = pixel * columns, .height = pixel * rows, .gap = kGap};
  }
  Heightfield fitted(const Heightfield& field) const {
    return field.width == columns && field.depth == rows ? field : resample(field, columns, rows);
  }
  double legend() const { return grid.bottom(); }
  figures::Sheet sheet() const { return {grid.sheet_width(), legend() + kLegend}; }
  void place(figures::Sheet& sheet, int number, std::string_view title, const Image& image) const {
    grid.place(sheet, number, fmt::format("({:c}) {}", 'a' + number, title), image);
  }
};

auto colour_between(const HeightRange& range) {
  return [range](float height) {
    const float span = range.highest - range.lowest;
    return figures::elevation_colour(span > 0 ? (height - range.lowest) / span : 0);
  };
}

// Colours each image pixel that contains the centre of a channel pixel, and each whose own centre lies in
// one. So no channel pixel is lost where the image is coarser than the ground, and none is widened where it
// is finer.
void draw_channel_pixels(const std::vector<std::uint32_t>& channels, const Heightfield& ground,
                         Image& image) {
  std::vector<bool> is_channel(ground.heights.size());
  for (const std::uint32_t pixel : channels) {
    is_channel[pixel] = true;
    const int i = static_cast<int>(pixel) % ground.width, j = static_cast<int>(pixel) / ground.width;
    image.set(at_middle(i, ground.width, image.width), at_middle(j, ground.depth, image.height),
              figures::kChannel);
  }
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const int i = at_middle(x, image.width, ground.width), j = at_middle(y, image.height, ground.depth);
      if (is_channel[static_cast<std::size_t>(j) * ground.width + i]) image.set(x, y, figures::kChannel);
    }
  }
}

// An entry of the legend; returns where the next one begins.
double add_swatch(figures::Sheet& sheet, double x, double y, Rgb colour, std::string_view words) {
  sheet.box(x, y, 22, 12, colour);
  sheet.text(x + 28, y + 11, words, 12);
  return x + 28 + 7.2 * static_cast<double>(words.size()) + kGap;
}

void add_elevations(figures::Sheet& sheet, double x, double y, const HeightRange& range) {
  const double middle = (static_cast<double>(range.lowest) + range.highest) / 2;
  figures::add_colour_key(sheet, x, y, "elevation, m", 100, 180, figures::elevation_colour,
                          {fmt::format("{:.0f}", range.lowest), fmt::format("{:.0f}", middle),
                           fmt::format("{:.0f}", range.highest)});
}

// A scale bar of about a quarter of the panel's width and a round number of metres, aligned right.
void add_scale(figures::Sheet& sheet, const Layout& layout, const Heightfield& ground) {
  const double metres_per_unit = static_cast<double>(ground.width) * ground.cell_x / layout.grid.width;
  const double wish = layout.grid.width / 4 * metres_per_unit,
               power = std::pow(10, std::floor(std::log10(wish)));
  const double length = power * (wish >= 5 * power ? 5 : wish >= 2 * power ? 2 : 1);
  const double right = layout.grid.sheet_width() - kGap, left = right - length / metres_per_unit,
               y = layout.legend() + 6;
  sheet.line(std::array{figures::SheetPoint{left, y - 4}, figures::SheetPoint{left, y + 4},
                        figures::SheetPoint{left, y}, figures::SheetPoint{right, y},
                        figures::SheetPoint{right, y - 4}, figures::SheetPoint{right, y + 4}},
             {.colour = kInk, .thickness = 1.5});
  const bool far = length >= 1000;
  sheet.text(right, y + 23, fmt::format("{:g} {}, north up", far ? length / 1000 : length, far ? "km" : "m"),
             12, "end");
}

}  // namespace

ChannelsSheet channels_sheet(const Study& study) {
  const Layout layout(study.ground, 2);
  const HeightRange range = height_range(study.ground);
  const Heightfield fitted = layout.fitted(study.ground);
  const Image relief = figures::shaded_map(fitted, figures::Light(fitted), colour_between(range));
  ChannelsSheet drawn{layout.sheet(), {}};
  figures::Sheet& sheet = drawn.sheet;
  int panel = 0;
  for (const std::uint32_t tau : kDrawnTaus) {
    const auto channels = channel_pixels(study.network, tau);
    Image image = relief;
    draw_channel_pixels(channels, study.ground, image);
    const auto count = static_cast<double>(channels.size());
    const double share = count / static_cast<double>(study.ground.heights.size() - range.no_data);
    layout.place(sheet, panel++,
                 fmt::format("τ = {}: {} channel pixels, {:.1f} %", tau, format_number(count), 100 * share),
                 image);
    drawn.maps.push_back(std::move(image));
  }
  const double next = add_swatch(sheet, kGap, layout.legend(), figures::kChannel, "channel");
  add_elevations(sheet, next, layout.legend(), range);
  add_scale(sheet, layout, study.ground);
  return drawn;
}

void draw_channels(const Study& study, Recorder& recorder) {
  const ChannelsSheet drawn = channels_sheet(study);
  const DrawnChannels seen = read_channels(drawn.maps, study.ground);
  for (std::size_t map = 0; map < kDrawnTaus.size(); ++map) {
    recorder.add(fmt::format("drawn_channel_pixels_tau_{}", kDrawnTaus[map]), "", seen.pixels[map]);
  }
  recorder.add("drawn_channel_pixels_outside_denser", "", seen.outside_denser);
  recorder.add("drawn_inland_networks", "", seen.inland);
  recorder.add("drawn_channels_low_share", "", seen.low_share);
  recorder.add("ground_low_share", "", seen.low_share_of_ground);
  drawn.sheet.write(
      recorder.figure("drill.F1" + study.suffix,
                      fmt::format("Redrawn after the paper\'s figure 1: channel networks at four thresholds "
                                  "τ over the shaded relief of {}, "
                                  "{} × {} samples. Each channel pixel is drawn. "
                                  "Elevations run from blue, the lowest, over green and brown to white.",
                                  study.name, study.ground.width, study.ground.depth)));
}

BestSheet best_sheet(const Study& study, const Outcome& least_rmse, const Outcome& least_ahd) {
  const Layout layout(study.ground, 1);
  const HeightRange range = height_range(study.ground);
  const Heightfield ground = layout.fitted(study.ground);
  const figures::Light light(ground);
  const auto elevations = colour_between(range);
  BestSheet best{layout.sheet(), {}};
  for (int panel = 0; panel < 2; ++panel) {
    const Outcome& outcome = panel == 0 ? least_rmse : least_ahd;
    const Drills drills =
        extract_drills(study.ground, study.network, options_for(outcome.setting, study.variant));
    const Heightfield regenerated = regenerate(drills), fitted = layout.fitted(regenerated);
    best.drawn[static_cast<std::size_t>(panel)] =
        compare(study.ground, study.network, drills, regenerated, outcome.setting, study.variant);
    const auto& [tau, w, k] = outcome.setting;
    layout.place(best.sheet, panel,
                 fmt::format("least {}: τ = {}, w = {}, k = {}; {:.1f} % untouched",
                             panel == 0 ? "RMSE" : "AHD", tau, w, k, 100 * outcome.untouched),
                 figures::shaded_map(fitted, figures::Light(fitted, light), [&](float height) {
                   return is_touched(height, drills) ? elevations(height) : figures::kUntouched;
                 }));
  }
  const double next = add_swatch(best.sheet, kGap, layout.legend(), figures::kUntouched, "no drill reaches");
  add_elevations(best.sheet, next, layout.legend(), range);
  add_scale(best.sheet, layout, study.ground);
  return best;
}

void draw_best(const Study& study, const Outcome& least_rmse, const Outcome& least_ahd, Recorder& recorder) {
  const BestSheet best = best_sheet(study, least_rmse, least_ahd);
  for (const auto& [panel, outcome] : {std::pair{"a", best.drawn[0]}, {"b", best.drawn[1]}}) {
    add_share(recorder, fmt::format("drawn_{}_rmse", panel), outcome.rmse);
    add_share(recorder, fmt::format("drawn_{}_ahd", panel), outcome.ahd[0]);
    add_share(recorder, fmt::format("drawn_{}_untouched", panel), outcome.untouched);
  }
  best.sheet.write(recorder.figure(
      "drill.F3" + study.suffix,
      fmt::format(
          "Redrawn after the paper\'s figure 3: {} regenerated, {}: (a) with the parameters of least RMSE, "
          "(b) with those of least AHD (the mean in plan). "
          "Where no drill reaches, the plateau remains.",
          study.name, study.variant.words)));
}

}  // namespace terrabench::drill
