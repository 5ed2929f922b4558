// Figures 20, 21 and 23 to 25 of "hybrid": the du/dv map and water, fog, the sky's noise map and clouds.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <memory>
#include <utility>

#include "experiments/cases.h"
#include "experiments/figures/figure.h"
#include "experiments/hybrid/noise_ground.h"
#include "experiments/scene.h"
#include "renderers/landscape/textures.h"

namespace terrabench::hybrid {
namespace {

using namespace figures;

constexpr glm::ivec2 kLarge{1000, 560}, kSmall{486, 272};  // pixels

using Settings = std::initializer_list<std::pair<std::string_view, Value>>;

// The noise terrain, drawn by the clipmap.
class Land {
 public:
  explicit Land(Drawing& drawing) : gl_(drawing.gl()) {
    Progress silent;
    field_ = scene_heights(wide_ground({}), kSamples, silent);
    lod_ = lod("clipmap").build(field_, Parameters(lod("clipmap").parameters), silent);
    lod_->tune(255);
  }

  LandscapeStyle style(Settings settings) const {
    Parameters parameters(landscape_parameters(), {{"water", 0.45}});
    for (const auto& [name, value] : settings) parameters.set(name, value);
    return make_style(parameters, bounds_of(field_));
  }
  // Eye and target lie at heights above the water.
  View view(glm::vec3 eye, glm::vec3 target, glm::ivec2 size) const {
    const glm::vec3 water(0, style({}).water_level, 0);
    View view;
    view.eye = eye + water;
    view.target = target + water;
    view.width = size.x;
    view.height = size.y;
    view.vertical_fov = 0.8F;
    view.near = 0.3F;
    view.far = 4 * field_.extent_x();
    return view;
  }
  Image draw(const View& view, Settings settings, double seconds = 0) {
    if (painter_) {
      painter_->renderer().restyle(style(settings));
    } else {
      painter_ = std::make_unique<ScenePainter>(gl_, *lod_, style(settings));
    }
    painter_->update(view);
    return painter_->draw(view, seconds);
  }

 private:
  static constexpr int kSamples = 769;

  GlContext& gl_;
  Heightfield field_;
  std::unique_ptr<Lod> lod_;
  std::unique_ptr<ScenePainter> painter_;
};

std::uint8_t byte_of(float share) {
  return static_cast<std::uint8_t>(std::lround(255 * std::clamp(share, 0.0F, 1.0F)));
}

Image image_of(int width, int height, const std::function<Rgb(int, int)>& colour) {
  Image image(width, height, {});
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) image.set(x, y, colour(x, y));
  }
  return image;
}

// As in the paper: red is du, green dv, each from -1 (dark) to 1; and as games store normals.
Sheet draw_dudv(Drawing& drawing) {
  constexpr int kSide = 512;
  const Texels map = wave_map(kSide, drawing.seed());
  const auto share = [&](int x, int y, int channel) {
    return 0.5F + 0.5F * map.at(x % kSide, y % kSide, channel);
  };
  const auto grey = [&](int channel) {
    return image_of(kSide, kSide, [&, channel](int x, int y) {
      const std::uint8_t value = byte_of(share(x, y, channel));
      return Rgb{value, value, value};
    });
  };
  const Image both = image_of(kSide, kSide, [&](int x, int y) {
    return Rgb{byte_of(share(x, y, 0)), byte_of(share(x, y, 1)), 0};
  });
  const Image normals = image_of(kSide, kSide, [&](int x, int y) {
    return Rgb{byte_of(1 - share(x, y, 2)), byte_of(1 - share(x, y, 3)), 255};
  });
  return panel_sheet({{{both, "du/dv map: red is du, green is dv"}, {grey(0), "du, black −1, white 1"}},
                      {{normals, "normal map of the same size"}, {grey(1), "dv, black −1, white 1"}}});
}

Sheet landscape_sheet(const PanelRows& rows) {
  Sheet sheet = panel_sheet(rows);
  sheet.keep_all_colours();
  return sheet;
}

View resized(View view, glm::ivec2 size) {
  view.width = size.x;
  view.height = size.y;
  return view;
}

Sheet draw_water(Drawing& drawing) {
  Land land(drawing);
  const View large = land.view({900, 12, 1300}, {760, -6, 900}, kLarge), small = resized(large, kSmall);
  const Value off = 0.0;
  const Image mirror = land.draw(
      small, {{"fresnel_normal", 1.0}, {"distortion", off}, {"wave_slope", off}, {"highlight", off}});
  // The printed reading reflects next to nothing in any view here.
  const Image glass = land.draw(small, {{"fresnel", std::string("light")},
                                        {"fresnel_normal", off},
                                        {"fresnel_power", 20.0},
                                        {"distortion", off},
                                        {"wave_slope", off},
                                        {"highlight", off}});
  const Image still = land.draw(small, {{"distortion", off}, {"wave_slope", off}, {"highlight", off}});
  const Image warped = land.draw(small, {{"wave_slope", off}, {"highlight", off}});
  return landscape_sheet({{{land.draw(large, {}, 2), "all parts, with a moving normal map and highlights"}},
                          {{mirror, "reflection alone"}, {glass, "refraction alone"}},
                          {{still, "mixed by the Fresnel term"}, {warped, "warped by the du/dv map"}}});
}

Sheet draw_fog(Drawing& drawing) {
  constexpr double kAzimuth = 33, kHeight = 8;
  Land land(drawing);
  const auto draw = [&](const View& view, double strength) {
    return land.draw(view, {{"sun_azimuth", kAzimuth},
                            {"sun_height", kHeight},
                            {"fog", 0.3},
                            {"fog_sun", strength},
                            {"cloud_cover", 0.3}});
  };
  const View towards = land.view({300, 45, 1200}, {600, 25, 740}, kLarge);
  const View away = land.view({1150, 60, 300}, {850, 35, 760}, kSmall);
  return landscape_sheet({{{draw(towards, 0.85), "towards the sun"}},
                          {{draw(resized(towards, kSmall), 0), "towards the sun, fog of one colour"},
                           {draw(away, 0.85), "away from the sun"}}});
}

// `turn`: by which the map is moved along the horizon.
Image grey_map(const Texels& map, double turn) {
  const int moved = static_cast<int>(turn * map.width);
  return image_of(map.width, map.height, [&](int x, int y) {
    const std::uint8_t value = byte_of(map.at((x + moved) % map.width, y));
    return Rgb{value, value, value};
  });
}

Sheet draw_sky_noise(Drawing& drawing) {
  const Texels map = sky_noise(1280, 480, drawing.seed(), 1);
  return panel_sheet(
      {{{grey_map(map, 0),
         "azimuth from north clockwise, from zenith (top) to horizon (bottom); black 0, white 1"}},
       {{grey_map(map, 0.5), "the same, turned by half: the ends meet in the middle, without a seam"}}});
}

Sheet draw_clouds(Drawing& drawing) {
  Land land(drawing);
  const View large = land.view({300, 30, 1200}, {560, 110, 740}, kLarge), small = resized(large, kSmall);
  return landscape_sheet({{{land.draw(large, {}), "clouds over the noise terrain"}},
                          {{land.draw(small, {}, 20), "20 s later"},
                           {land.draw(small, {{"cloud_cover", 0.75}}), "with more clouds"}}});
}

constexpr std::array<Figure, 5> kFigures{{
    {20, "F20", "the du/dv map of the water, from the gradient of seamless noise, and its normal map",
     draw_dudv},
    {21, "F21", "the water as rendered, and its parts: the noise terrain, drawn by the clipmap", draw_water},
    {23, "F23", "fog that takes the sun's colour towards the sun, 8° above the horizon", draw_fog},
    {24, "F24", "the noise map of the sky, on a dome of clouds around the eye", draw_sky_noise},
    {25, "F25",
     "clouds: the share t = (cos(iπ) + 1) ÷ 2 of sky colour where the noise map is i, moving with time",
     draw_clouds},
}};
constexpr std::array kNames = names_of(kFigures);
const std::array kSpecs{choice("figure", kNames, "figure of the paper")};

std::vector<Case> cases(const RunOptions&) { return cases_by("figure", kSpecs); }

void draw(const Case& at, const RunOptions& options, Recorder& recorder, Progress&) {
  draw_figure(kFigures, "hybrid", at, options, recorder);
}

}  // namespace

extern const Experiment kLandscape{"hybrid.landscape", "Figures 20, 21 and 23-25: water, fog and sky", kSpecs,
                                   cases, draw};

}  // namespace terrabench::hybrid
