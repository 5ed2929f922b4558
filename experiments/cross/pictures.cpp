#include "experiments/cross/pictures.h"

#include <fmt/format.h>

#include "experiments/drill/ground.h"
#include "experiments/drill/sheet.h"
#include "lod/brute_force/brute_force.h"

namespace terrabench::cross {
namespace {

constexpr double kPanel = 400, kLabel = 30, kGap = 14;  // units of the sheet, each two pixels
constexpr int kColumns = 3;
constexpr int kWarmUp = 8;  // frames before the pictured one, so that methods that keep a mesh have one

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

void draw_wires(Flight& flight, double pixels, GlContext& context, Recorder& recorder, Progress& progress) {
  // Half-way, where the paths are close to the ground.
  const std::size_t last = flight.metered[flight.metered.size() / 2];
  const View& view = flight.views[last];
  const double ratio = static_cast<double>(view.height) / view.width;
  const double row = kLabel + kPanel * ratio + kGap;
  const auto panels = static_cast<int>(lods().size());
  drill::Sheet sheet(kColumns * (kPanel + kGap) + kGap, (panels + kColumns - 1) / kColumns * row + kGap);
  int panel = 0;
  for (const LodType& type : lods()) {
    const Tuned tuned = tune_to(flight, type, pixels, progress);
    const std::unique_ptr<Lod> lod = type.build(flight.ground(), Parameters(type.parameters), progress);
    lod->tune(tuned.knob);
    for (std::size_t i = last > kWarmUp ? last - kWarmUp : 0; i < last; ++i) lod->update(flight.views[i]);
    const Frame& frame = lod->update(view);
    FrameRenderer renderer(context);
    draw_ground(renderer, flight, frame, view, 1);
    const double x = kGap + panel % kColumns * (kPanel + kGap), y = kGap + panel / kColumns * row;
    sheet.text(x, y + kLabel - 10, fmt::format("{}: {} triangles", type.name, frame.stats.triangles), 17);
    sheet.picture(x, y + kLabel, kPanel, kPanel * ratio, renderer.image());
    recorder.add(fmt::format("{}_triangles", type.name), "", static_cast<double>(frame.stats.triangles));
    ++panel;
  }
  const std::string suffix =
      flight.route.terrain == kMainGround ? "" : drill::figure_suffix(flight.route.terrain);
  sheet.write(recorder.figure(
      "cross.lod-wires" + suffix, "png",
      fmt::format(
          "{}: every method's triangles in the same view, each tuned to {:g} px at the 99th percentile "
          "over the path {}; colours by height from {:.0f} to {:.0f} m",
          flight.source.name, pixels, flight.route.path, flight.lowest, flight.highest)));
}

}  // namespace terrabench::cross
