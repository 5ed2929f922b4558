// The picture that the hybrid paper is about: rock that overhangs water, in a landscape that ends in the sky.
// The noise terrain; where it is, from where it is seen and what draws it are parameters.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "experiments/experiment.h"
#include "experiments/hybrid/noise_ground.h"
#include "experiments/scene.h"

namespace terrabench::hybrid {
namespace {

// Found by a search for roofs over water that are open to two sides, and by looking: at 166, 94 the terrain
// of this seed has an arch over a bay.
const ParameterSpec kSpecs[] = {
    {"terrain_seed", std::int64_t{22}, "", "seed of the noise terrain", 0, 1e9},
    {"cube", 256.0, "m", "side of the noise graph's cube; features scale with it", 1, 1e5},
    {"cubes", std::int64_t{6}, "", "cubes along each side of the landscape", 1, 64},
    {"samples", std::int64_t{769}, "", "height samples along each side", 2, 8193},
    {"lod", std::string("clipmap"), "", "level-of-detail method"},
    {"detail", 511.0, "", "the method's knob"},
    {"water_level", 112.0, "m", "height of the water", 0, 1e5},
    {"eye_x", 145.0, "m", "place of the eye: east"},
    {"eye_y", 117.0, "m", "place of the eye: up"},
    {"eye_z", 145.0, "m", "place of the eye: south"},
    {"target_x", 168.0, "m", "place in the middle of the picture: east"},
    {"target_y", 124.0, "m", "place in the middle of the picture: up"},
    {"target_z", 88.0, "m", "place in the middle of the picture: south"},
    {"field_of_view", 60.0, "°", "vertical", 1, 170},
    {"sun_azimuth", 235.0, "°", "direction of the sun, clockwise from north", -360, 360},
    {"sun_height", 24.0, "°", "height of the sun above the horizon", 0, 90},
    {"width", std::int64_t{1600}, "pixels", "width of the picture", 16, 16384},
    {"height", std::int64_t{900}, "pixels", "height of the picture", 16, 16384},
};

std::vector<Case> cases(const RunOptions& options) {
  Case one{"hero", Parameters(kSpecs)};
  if (options.profile == Profile::kQuick) {  // a smaller picture of coarser ground
    one.parameters.set("width", std::int64_t{800});
    one.parameters.set("height", std::int64_t{450});
    one.parameters.set("samples", std::int64_t{385});
    one.parameters.set("detail", 255.0);
  }
  return {one};
}

float number(const Parameters& p, std::string_view name) { return static_cast<float>(p.number(name)); }

LandscapeStyle style_of(const Parameters& p, const Bounds& ground) {
  const float relief = std::max(ground.size().y, 1e-3F);
  const double water = std::clamp((number(p, "water_level") - ground.low.y) / relief, 0.0F, 1.0F);
  return make_style(Parameters(landscape_parameters(), {{"water", water},
                                                        {"sun_azimuth", p.number("sun_azimuth")},
                                                        {"sun_height", p.number("sun_height")}}),
                    ground);
}

View view_of(const Case& at, float extent) {
  const Parameters& p = at.parameters;
  View view;
  view.eye = {number(p, "eye_x"), number(p, "eye_y"), number(p, "eye_z")};
  view.target = {number(p, "target_x"), number(p, "target_y"), number(p, "target_z")};
  view.vertical_fov = number(p, "field_of_view") * 3.14159265F / 180;
  view.width = at.integer("width");
  view.height = at.integer("height");
  view.near = 0.3F;
  view.far = 4 * extent;
  return view;
}

void measure(const Case& at, const RunOptions& options, Recorder& recorder, Progress& progress) {
  const Parameters& p = at.parameters;
  const TerrainSource source =
      recorder.terrain(wide_ground({.seed = static_cast<std::uint64_t>(p.integer("terrain_seed")),
                                    .cube = number(p, "cube"),
                                    .cubes = at.integer("cubes")}));
  const Heightfield field = scene_heights(source, at.integer("samples"), progress);
  const LodType& type = lod(p.text("lod"));
  const auto method = type.build(field, Parameters(type.parameters), progress);
  method->tune(p.number("detail"));
  const View view = view_of(at, field.extent_x());
  check_eye(view, method->update(view), source, field);
  const auto context = open_context(options.renderer, view.width, view.height);
  ScenePainter painter(*context, *method, style_of(p, bounds_of(field)));
  recorder.add("triangles", "", painter.update(view).stats.triangles);
  write_png(
      recorder.figure("hybrid.hero", "png",
                      fmt::format("The noise terrain of the paper by the method {}: rock over water, in a "
                                  "landscape that ends in the sky",
                                  type.name)),
      painter.draw(view, 3));
}

}  // namespace

extern const Experiment kHero{"hybrid.hero", "The picture of the whole: rock over water under the sky",
                              kSpecs, cases, measure};

}  // namespace terrabench::hybrid
