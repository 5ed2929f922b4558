#include "experiments/cross/pictures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>

#include "experiments/figures/figure_id.h"
#include "experiments/figures/sheet.h"
#include "lod/brute_force/brute_force.h"
#include "results/format.h"

namespace terrabench::cross {
namespace {

constexpr double kPanel = 400, kLabel = 30, kGap = 14;  // units of the sheet, each two pixels
constexpr std::size_t kColumns = 3;
constexpr int kSky = 8;     // pixels left over the horizon
constexpr int kWarmUp = 8;  // frames before the pictured one, so that methods that keep a mesh have one

// The first row with anything on it.
int horizon(const Image& image, Rgb background) {
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      if (image.pixel(x, y) != background) return y;
    }
  }
  return 0;
}

Image without_rows(const Image& image, int rows) {
  Image rest(image.width, image.height - rows, {});
  rest.rgb.assign(image.rgb.begin() + std::ptrdiff_t{3} * rows * image.width, image.rgb.end());
  return rest;
}

}  // namespace

void draw_ground(FrameRenderer& renderer, const Flight& flight, const Frame& frame, const View& view,
                 float wires) {
  renderer.draw(frame, view, {.lowest = flight.lowest, .highest = flight.highest, .wire_width = wires});
  renderer.finish();
}

void draw_reference(Flight& flight, GlContext& context, Progress& progress) {
  if (!flight.pictures.empty()) return;
  BruteForce full(flight.ground());
  FrameRenderer renderer(context);
  const std::vector<std::size_t> chosen = pictured(flight);
  progress.begin(fmt::format("drawing the full {}", flight.route.terrain), chosen.size());
  for (const std::size_t k : chosen) {
    const View& view = flight.views[flight.metered[k]];
    draw_ground(renderer, flight, full.update(view), view);
    flight.pictures.push_back(renderer.image());
    progress.advance();
  }
  progress.end();
}

void draw_wires(Flight& flight, double pixels, const std::string& options, GlContext& context,
                Recorder& recorder, Progress& progress) {
  // Half-way, where the paths are close to the ground.
  const std::size_t last = flight.metered[flight.metered.size() / 2];
  const View& view = flight.views[last];
  struct Panel {
    std::string words;
    Image image;
  };
  std::vector<Panel> panels;
  int sky = view.height;
  for (const LodType& type : lods()) {
    const Contender method = contender(type.name, options);
    const Tuned tuned = tune_to(flight, method, pixels, progress);
    const std::unique_ptr<Lod> lod = method.build(flight.ground(), progress);
    lod->tune(tuned.knob);
    for (std::size_t i = last > kWarmUp ? last - kWarmUp : 0; i < last; ++i) lod->update(flight.views[i]);
    const Frame& frame = lod->update(view);
    FrameRenderer renderer(context);
    draw_ground(renderer, flight, frame, view, 1);
    const auto triangles = static_cast<double>(frame.stats.triangles);
    panels.push_back(
        {fmt::format("{}: {} triangles", type.name, format_number(triangles)), renderer.image()});
    sky = std::min(sky, std::max(0, horizon(panels.back().image, FrameStyle{}.background) - kSky));
    recorder.add(fmt::format("{}_triangles", type.name), "", triangles);
  }
  const double height = kPanel * (view.height - sky) / view.width, row = kLabel + height + kGap;
  const auto rows = static_cast<double>((panels.size() + kColumns - 1) / kColumns);
  figures::Sheet sheet(kColumns * (kPanel + kGap) + kGap, rows * row + kGap);
  for (std::size_t i = 0; i < panels.size(); ++i) {
    const double x = kGap + static_cast<double>(i % kColumns) * (kPanel + kGap);
    const double y = static_cast<double>(i / kColumns) * row;
    sheet.text(x, y + kLabel - 8, panels[i].words, 16);
    sheet.picture(x, y + kLabel, kPanel, height, without_rows(panels[i].image, sky));
  }
  const std::string suffix = figures::ground_suffix(flight.route.terrain, kMainGround);
  sheet.write(recorder.figure(
      "cross.lod-wires" + suffix, "png",
      fmt::format(
          "{}: every method's triangles in the same view, each tuned to {:g} px at the 99th percentile "
          "over the path {}; colours by height from {:.0f} to {:.0f} m",
          flight.source.name, pixels, flight.route.path, flight.lowest, flight.highest)));
}

}  // namespace terrabench::cross
