// The picture that the hybrid paper is about: an arch over water, in a landscape that ends in the sky.
// The ground near the eye is the implicit surface of the stacks, with grass on it, the ground beyond a
// clipmap of their heights. Where it is, from where it is seen and what draws it are parameters.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "experiments/experiment.h"
#include "experiments/figures/sheet.h"
#include "experiments/hybrid/grounds.h"
#include "experiments/near_ground.h"
#include "experiments/scene.h"
#include "terrain/framing.h"

namespace terrabench::hybrid {
namespace {

// Found by a search for roofs over water that are open to two sides, and by looking: at 166, 94 the terrain
// of this seed has an arch over a bay.
const ParameterSpec kSpecs[] = {
    {"terrain_seed", std::int64_t{22}, "", "seed of the noise terrain", 0, 1e9},
    {"cube", 256.0, "m", "side of the noise graph's cube; features scale with it", 1, 1e5},
    {"cubes", std::int64_t{6}, "", "cubes along each side of the landscape", 1, 64},
    {"columns", std::int64_t{1536}, "columns", "of the stacks, along each side", 32, 8192},
    {"radius", std::int64_t{4}, "chunks", "of the near surface on each side of the eye's own", 1, 64},
    {"window", 511.0, "samples", "side of each level of the clipmap", 15, 4095},
    {"grass", 8.0, "1/m²", "strands of grass on the near surface", 0, 1000},
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
    one.parameters.set("columns", std::int64_t{768});
    one.parameters.set("radius", std::int64_t{2});
    one.parameters.set("window", 255.0);
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
  const NearGround ground = near_ground(source, at.integer("columns"), 1, progress);
  const LodType& type = lod("hybrid");
  const auto method =
      type.build(ground.lod(), Parameters(type.parameters, {{"radius", p.integer("radius")}}), progress);
  method->tune(p.number("window"));
  const View view = view_of(at, ground.heights.extent_x());
  check_eye(view, method->update(view), source, ground.heights);
  const auto context = open_context(options.renderer, view.width, view.height);
  const LandscapeStyle style = style_of(p, bounds_of(ground.heights));
  ScenePainter painter(*context, *method, style);
  painter.grow(Parameters(grass_parameters(), {{"grass", p.number("grass")}}), style);

  recorder.add("triangles", "", static_cast<double>(painter.update(view).stats.triangles));
  recorder.add("strands", "", static_cast<double>(painter.strands()));
  write_picture(
      recorder
          .figure("hybrid.hero",
                  "Noise terrain made as in the paper: an arch over water, in a landscape that ends in "
                  "the sky. The ground near the eye is an implicit surface with grass, the ground "
                  "beyond a clipmap")
          .path,
      painter.draw(view, 3));
}

}  // namespace

extern const Experiment kHero{
    "hybrid.hero", "All techniques together: an arch over water, in a landscape that ends in the sky", kSpecs,
    cases, measure};

}  // namespace terrabench::hybrid
