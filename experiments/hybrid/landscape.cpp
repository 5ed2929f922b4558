// Figures 20, 21 and 23 to 25 of "hybrid": the du/dv map and water, fog, the sky's noise map and clouds.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <memory>
#include <utility>

#include "experiments/figures/figure.h"
#include "experiments/hybrid/grounds.h"
#include "experiments/hybrid/landscape_measures.h"
#include "experiments/hybrid/pixels.h"
#include "experiments/scene.h"
#include "renderers/landscape/textures.h"
#include "terrain/framing.h"

namespace terrabench::hybrid {
namespace {

using namespace figures;

constexpr glm::ivec2 kLarge{1600, 720}, kSmall{786, 354};  // pixels

constexpr Rgb kAxis{96, 96, 96};

using Settings = std::initializer_list<std::pair<std::string_view, Value>>;

// Built once for the three figures that show it: by far the most of their time.
const Heightfield& noise_terrain() {
  constexpr int kSamples = 1025;  // a metre and a half apart
  static const Heightfield field = [] {
    Progress silent;
    return scene_heights(wide_ground({}), kSamples, silent);
  }();
  return field;
}

// The noise terrain, drawn by the clipmap.
class Land {
 public:
  explicit Land(Drawing& drawing) : gl_(drawing.gl()), field_(noise_terrain()) {
    Progress silent;
    lod_ = lod("clipmap").build(field_, Parameters(lod("clipmap").parameters), silent);
    lod_->tune(383);
  }

  LandscapeStyle style(Settings settings) const {
    // Rock where the paper's formula, (1 - n_y)·90°, gives more than 20°: the true angle there is 39°.
    Parameters parameters(landscape_parameters(),
                          {{"water", 0.45}, {"slope_rule", std::string("printed")}, {"steep", 20.0}});
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
    view.vertical_fov = 0.68F;
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
  GlContext& gl_;
  const Heightfield& field_;
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
  constexpr int kSide = 720;
  const Texels map = wave_map(kSide, drawing.seed());
  const SlopeMap warp = measure_slopes(map, 0, 1), normal = measure_slopes(map, 2, 3);
  drawing.record("warp_curl", warp.curl);
  drawing.record("normal_curl", normal.curl);
  drawing.record("seam_step", warp.seam_step);
  drawing.record("largest_step", warp.largest_step);
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
  return panel_sheet(
      {{{both, "du/dv map, 7 m × 7 m of water: red du, green dv"}, {grey(0), "du, black −1, white 1"}},
       {{normals, "normal map of the same 7 m × 7 m"}, {grey(1), "dv, black −1, white 1"}}});
}

View resized(View view, glm::ivec2 size) {
  view.width = size.x;
  view.height = size.y;
  return view;
}

// The part of a small picture that shows the water and what is mirrored in it, to keep the file small.
Image around_the_water(const Image& whole) {
  constexpr int kFrom = 130, kTo = 330;  // rows
  return image_of(whole.width, kTo - kFrom, [&](int x, int y) { return whole.pixel(x, y + kFrom); });
}

Sheet draw_water(Drawing& drawing) {
  Land land(drawing);
  const View large = land.view({900, 12, 1300}, {760, -6, 900}, {1600, 640}), small = resized(large, kSmall);
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
  const WaterMix mix = measure_mix(mirror, glass, still, small);
  drawing.record("between_the_parts", mix.between);
  drawing.record("reflected_near", mix.near);
  drawing.record("reflected_near_schlick", mix.near_schlick);
  drawing.record("reflected_far", mix.far);
  drawing.record("reflected_far_schlick", mix.far_schlick);
  drawing.record("warped_water", share_changed(still, warped, mirror, glass, true));
  drawing.record("warped_land", share_changed(still, warped, mirror, glass, false));
  return panel_sheet(
      {{{land.draw(large, {}, 2), "all parts, with a moving normal map and highlights"}},
       {{around_the_water(mirror), "reflection alone"}, {around_the_water(glass), "refraction alone"}},
       {{around_the_water(still), "mixed by the Fresnel term"},
        {around_the_water(warped), "warped by the du/dv map"}}});
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
  const Image coloured = draw(towards, 0.85), plain = draw(resized(towards, kSmall), 0),
              behind = draw(away, 0.85);
  // Far hills in fog: under the sun, and where the view is farthest from it.
  constexpr Part kUnderSun{0.4, 0.6, 0.42, 0.52}, kLeft{0, 0.2, 0.42, 0.52}, kRight{0.8, 1, 0.42, 0.52};
  drawing.record("warmth_under_the_sun", mean_over(coloured, kUnderSun, warmth));
  drawing.record("warmth_left", mean_over(coloured, kLeft, warmth));
  drawing.record("warmth_right", mean_over(coloured, kRight, warmth));
  drawing.record("warmth_of_one_colour", mean_over(plain, kUnderSun, warmth));
  drawing.record("warmth_away", mean_over(behind, kUnderSun, warmth));
  return panel_sheet({{{coloured, "towards the sun"}},
                      {{plain, "towards the sun, fog of one colour"}, {behind, "away from the sun"}}});
}

// Rows `from` to `to` of the map, moved along the horizon by `turn`.
Image grey_map(const Texels& map, double turn, int from, int to) {
  const int moved = static_cast<int>(turn * map.width);
  return image_of(map.width, to - from, [&](int x, int y) {
    const std::uint8_t value = byte_of(map.at((x + moved) % map.width, y + from));
    return Rgb{value, value, value};
  });
}

// Azimuth below the map, the angle above the horizon beside it.
Sheet draw_sky_noise(Drawing& drawing) {
  constexpr int kWidth = 1600, kHeight = 600, kStripFrom = 300, kStripTo = 500;
  constexpr double kLeft = 48, kTop = 28, kRight = 24, kGap = 70, kBelow = 56;
  constexpr double kUnit = Sheet::kPixels, kWide = kWidth / kUnit;
  const Texels map = sky_noise(kWidth, kHeight, drawing.seed(), 1);
  const Seam seam = measure_seam(map);
  drawing.record("seam_step", seam.at_seam);
  drawing.record("largest_step", seam.elsewhere);
  const auto [least, most] = std::minmax_element(map.values.begin(), map.values.begin() + kWidth);
  drawing.record("zenith_spread", *most - *least);
  drawing.record("share_below_half",
                 static_cast<double>(std::ranges::count_if(map.values, [](float v) { return v < 0.5F; })) /
                     static_cast<double>(map.values.size()));
  Sheet sheet(kLeft + kWide + kRight, kTop + (kHeight + kStripTo - kStripFrom) / kUnit + kGap + kBelow);
  const auto panel = [&](double y, double turn, int from, int to) {
    sheet.picture(kLeft, y, kWide, (to - from) / kUnit, grey_map(map, turn, from, to));
    for (int k = 0; k <= 4; ++k) {
      const double x = kLeft + kWide * k / 4, below = y + (to - from) / kUnit;
      sheet.stroke({x, below}, {x, below + 5}, kAxis, 1);
      sheet.text(x, below + 18, fmt::format("{}°", static_cast<int>(90 * k + 360 * turn) % 360), 13,
                 "middle");
    }
    for (int elevation = 90; elevation >= 0; elevation -= 15) {
      const double row = kHeight * (1 - elevation / 90.0);
      if (row < from || row > to) continue;
      sheet.stroke({kLeft - 5, y + (row - from) / kUnit}, {kLeft, y + (row - from) / kUnit}, kAxis, 1);
      sheet.text(kLeft - 8, y + (row - from) / kUnit + 5, fmt::format("{}°", elevation), 13, "end");
    }
  };
  const double strip = kTop + kHeight / kUnit + kGap;
  sheet.text(kLeft, kTop - 9,
             "Intensity: black 0, white 1. Up: angle above the horizon; across: azimuth from north", 13);
  panel(kTop, 0, 0, kHeight);
  sheet.text(kLeft, strip - 9, "A strip, turned by half: the ends meet in the middle, without a seam", 13);
  panel(strip, 0.5, kStripFrom, kStripTo);
  return sheet;
}

Sheet draw_clouds(Drawing& drawing) {
  Land land(drawing);
  const View large = land.view({300, 30, 1200}, {560, 110, 740}, kLarge), small = resized(large, kSmall);
  // The noise map is the intensity itself, and clouds have one colour.
  const Settings printed{{"cloud_cover", 0.75}, {"cloud_softness", 1.0}, {"cloud_shading", 0.0}};
  constexpr double kLater = 20;  // seconds
  const Image now = land.draw(large, {}), later = land.draw(small, {}, kLater),
              as_printed = land.draw(small, printed);
  const LandscapeStyle style = land.style({});
  const Texels noise = sky_noise(2048, 768, style.seed, style.cloud_size);
  const double turned = kLater * style.cloud_speed;
  drawing.record("match", cloud_match(now, large, noise, 0));
  drawing.record("match_of_later_clouds", cloud_match(now, large, noise, turned));
  drawing.record("later_match", cloud_match(later, small, noise, turned));
  drawing.record("later_match_of_first_clouds", cloud_match(later, small, noise, 0));
  drawing.record("printed_match", cloud_match(as_printed, small, noise, 0));
  return panel_sheet(
      {{{now, "i = (n − 0.4) ÷ 0.6, at least 0, of the noise n; clouds shaded by thickness and sun"}},
       {{later, "the same, 20 s later"}, {as_printed, "as printed: i = n, and one colour of cloud"}}});
}

constexpr std::array<Figure, 5> kFigures{{
    {20, "F20", "the du/dv map of the water, from the gradient of seamless noise, and its normal map",
     draw_dudv},
    {21, "F21",
     "the water as rendered, and its parts. The ground is the noise terrain's height map, drawn by the "
     "clipmap; it is rock where §4.1's angle, (1 − n_y) · 90°, exceeds 20°",
     draw_water},
    {23, "F23",
     "fog that takes the sun's colour towards the sun, 8° above the horizon; ground as in figure 21",
     draw_fog},
    {24, "F24", "the noise map of the sky, on a dome of clouds around the eye", draw_sky_noise},
    {25, "F25",
     "clouds: the share t = (cos(iπ) + 1) ÷ 2 of sky colour, i from the noise map of figure 24, which moves "
     "with time; ground as in figure 21",
     draw_clouds},
}};

}  // namespace

extern const Experiment kLandscape =
    figures::figure_experiment<kFigures>("hybrid.landscape", "Figures 20, 21 and 23-25: water, fog and sky");

}  // namespace terrabench::hybrid
