#include "experiments/cross/pictures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>

#include "experiments/figures/figure_id.h"
#include "experiments/figures/maps.h"
#include "lod/brute_force/brute_force.h"
#include "results/format.h"

namespace terrabench::cross {
namespace {

constexpr double kPanel = 400;  // units of the sheet
constexpr int kColumns = 3;
constexpr int kSky = 8;     // pixels kept above the horizon
constexpr int kWarmUp = 8;  // frames before the pictured one, for methods that keep a mesh between frames

// The first row that is not all background.
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
  // Halfway along the path, where it is close to the ground.
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
  const int count = static_cast<int>(panels.size());
  const figures::PanelGrid grid{.columns = kColumns,
                                .rows = (count + kColumns - 1) / kColumns,
                                .width = kPanel,
                                .height = kPanel * (view.height - sky) / view.width,
                                .gap = 14,
                                .below = 14,
                                .title = 30,
                                .text_size = 16};
  figures::Sheet sheet(grid.sheet_width(), grid.bottom() + grid.gap);
  for (int i = 0; i < count; ++i) {
    grid.place(sheet, i, panels[i].words, without_rows(panels[i].image, sky));
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
