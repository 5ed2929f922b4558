#include "viewer/equal_error.h"

#include <fmt/format.h>

#include "lod/meters/knob_search.h"
#include "lod/meters/screen_error.h"

namespace terrabench::viewer {

void search(EqualError& of, const View& view, double pixels, Progress& progress) {
  const Heightfield& ground = of.ground->heights;
  const Knob& knob = of.method.type->knob;
  const SeenSamples seen(ground, view);
  const std::unique_ptr<Lod> lod = of.method.type->build(of.ground->lod(), of.method.options, progress);
  SurfaceRaster drawn(ground.width, ground.depth);
  const auto error_at = [&](double setting) {
    progress.begin(fmt::format("{}: trying {} = {:.4g}", of.method.label, knob.name, setting), 1);
    lod->tune(setting);
    drawn.draw(lod->update(view));
    const double error = screen_error(drawn, ground, seen).visible.p99;
    progress.advance();
    return error;
  };
  const Tuned tuned = of.method.type->tunable() ? search_knob(knob, pixels, error_at)
                                                : Tuned{knob.fallback, error_at(knob.fallback), true};
  progress.end();
  of.knob = tuned.knob;
  of.error = tuned.error;
  of.reached = tuned.reached;
}

std::string describe(const EqualError& of) {
  const Knob& knob = of.method.type->knob;
  std::string text = fmt::format("{} {:.3g} px", of.method.label, of.error);
  if (of.method.type->tunable()) text += fmt::format(" at {} {:.4g} {}", knob.name, of.knob, knob.unit);
  return text + (of.reached ? "" : " (no setting comes nearer)");
}

}  // namespace terrabench::viewer
