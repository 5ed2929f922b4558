// §4.2 and §4.4 of "hybrid", measured in pictures of level ground: the share of fog by distance, the sun's
// colour in it by direction, and the ground's border, which blends into the sky.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "experiments/cases.h"
#include "experiments/figures/mesh_frame.h"
#include "experiments/hybrid/pixels.h"
#include "renderers/landscape/landscape.h"

namespace terrabench::hybrid {
namespace {

using figures::MeshFrame;

constexpr std::array<std::string_view, 3> kParts{"fog", "border", "border-without-blending"};
const std::array kSpecs{
    choice("part", kParts, "fog with the sun's colour; the border's blend into the sky, or none"),
    ParameterSpec{"side", 2000.0, "m", "of the ground, whose middle the eye stands over", 100, 1e5},
    ParameterSpec{"eye", 30.0, "m", "height of the eye", 1, 1000},
};
constexpr double kFog = 0.2;  // of the side: the distance at which fog leaves 1/e of the ground's colour

std::vector<Case> cases(const RunOptions&) { return cases_by("part", kSpecs); }

// Over the middle, looking level in a direction clockwise from north.
View level_view(const Case& at, double degrees) {
  const auto side = static_cast<float>(at.parameters.number("side"));
  const auto turn = static_cast<float>(degrees * std::numbers::pi / 180);
  View view;
  view.eye = {side / 2, static_cast<float>(at.parameters.number("eye")), side / 2};
  view.target = view.eye + glm::vec3(std::sin(turn), 0, -std::cos(turn));
  view.width = 201;
  view.height = 400;
  view.vertical_fov = 0.6F;
  view.near = 1;
  view.far = 2 * side;
  return view;
}

// From the eye to level ground at a pixel's middle, metres; 0 above the horizon.
double distance_at(const View& view, int x, int y) {
  const double slope = std::tan(view.vertical_fov / 2.0), across = slope * view.width / view.height;
  const double up = slope * (1 - 2 * (y + 0.5) / view.height),
               right = across * (2 * (x + 0.5) / view.width - 1);
  return up < 0 ? view.eye.y / -up * std::sqrt(1 + up * up + right * right) : 0;
}

// A landscape of black ground, which shows nothing but the air, without water, shadows, occlusion and clouds.
LandscapeStyle style_of(const Case& at, std::initializer_list<std::pair<std::string_view, Value>> settings) {
  Parameters look(landscape_parameters(),
                  {{"water", 0.0}, {"shadows", false}, {"occlusion", 0.0}, {"cloud_cover", 0.0}});
  for (const char* material : {"sand_color", "grass_color", "earth_color", "rock_color", "snow_color"})
    look.set(material, std::string("#000000"));
  for (const auto& [name, value] : settings) look.set(name, value);
  const auto side = static_cast<float>(at.parameters.number("side"));
  return make_style(look, {{0, 0, 0}, {side, 0, side}});
}

LandscapeStyle foggy(const Case& at, double sun) {
  return style_of(at, {{"fog_color", std::string("#808080")},
                       {"fog", kFog},
                       {"fog_sun", sun},
                       {"sun_azimuth", 90.0},
                       {"sun_height", 8.0},
                       {"border", 0.0}});
}

// The share of fog as the landscape defines it; the paper says only that distance decides it.
double defined_share(const Case& at, double distance) {
  const double thick = distance / (kFog * at.parameters.number("side"));
  return 1 - std::exp(-thick * thick);
}

// Where the definition leaves less than one step of an 8-bit colour of the ground.
double hidden_from(const Case& at) {
  return kFog * at.parameters.number("side") * std::sqrt(std::log(255.0));
}

// The warmth of fog before ground that it hides.
double tint(LandscapeRenderer& renderer, const MeshFrame& ground, const Case& at, double from_sun) {
  const View view = level_view(at, 90 + from_sun);
  renderer.draw(ground.frame(), view);
  const Image image = renderer.image();
  const auto hidden = [&](int y) {
    const double distance = distance_at(view, view.width / 2, y);
    return distance <= 0 || distance > hidden_from(at);
  };
  int y = 0;
  while (y + 1 < view.height && hidden(y + 1)) ++y;  // the nearest such row
  return warmth(image.pixel(view.width / 2, y));
}

void measure_fog(const Case& at, const MeshFrame& ground, GlContext& context, Recorder& recorder) {
  LandscapeRenderer renderer(context, foggy(at, 0));
  const View view = level_view(at, 0);
  renderer.draw(ground.frame(), view);
  const Image image = renderer.image();
  const double whole = light_of(0x80);
  std::vector<std::pair<double, double>> shares;  // by distance
  for (int y = 0; y < view.height; ++y) {
    for (int x = 0; x < view.width; x += 20) {
      const double distance = distance_at(view, x, y);
      if (distance > 0 && distance < 0.45 * at.parameters.number("side"))
        shares.emplace_back(distance, light_of(image.pixel(x, y)[1]) / whole);
    }
  }
  std::sort(shares.begin(), shares.end());
  double most = 0, fall = 0, off = 0;
  for (const auto& [distance, share] : shares) {
    fall = std::max(fall, most - share);
    most = std::max(most, share);
    off = std::max(off, std::abs(share - defined_share(at, distance)));
  }
  recorder.add("nearest_share", "", shares.front().second);
  recorder.add("middle_share", "", shares[shares.size() / 2].second);
  recorder.add("farthest_share", "", shares.back().second);
  recorder.add("largest_fall", "", fall);
  recorder.add("off_the_definition", "", off);

  renderer.restyle(foggy(at, 1));
  for (const int from_sun : {0, 20, 40, 180})
    recorder.add("tint_" + std::to_string(from_sun), "", tint(renderer, ground, at, from_sun));
}

// How much a row of the picture differs from the sky behind the ground, in the display's units.
double row_difference(const Image& image, const Image& sky, int y) {
  double sum = 0;
  for (int x = 0; x < image.width; ++x) {
    for (int c = 0; c < 3; ++c) sum += std::abs(int{image.pixel(x, y)[c]} - sky.pixel(x, y)[c]);
  }
  return sum / (3.0 * 255 * image.width);
}

void measure_border(const Case& at, const MeshFrame& ground, GlContext& context, Recorder& recorder) {
  const double width = at.parameters.text("part") == "border" ? 0.2 : 0.0;  // share of the side
  LandscapeRenderer renderer(context, style_of(at, {{"border", width}, {"fog", 1000.0}}));
  const View view = level_view(at, 0);
  renderer.draw(ground.frame(), view);
  const Image image = renderer.image();
  renderer.draw({}, view);
  const Image sky = renderer.image();
  double at_border = -1, before = 0, rise = 0, inside = 0;
  for (int y = 0; y < view.height; ++y) {
    const double distance = distance_at(view, view.width / 2, y);
    if (distance <= 0 || distance > 0.499 * at.parameters.number("side")) continue;
    const double difference = row_difference(image, sky, y);
    if (at_border < 0) {
      at_border = difference;
    } else {
      rise = std::max(rise, before - difference);  // towards the border
    }
    before = difference;
    inside = std::max(inside, difference);
  }
  recorder.add("difference_at_the_border", "", at_border);
  recorder.add("largest_difference", "", inside);
  recorder.add("largest_rise", "", rise);
}

void measure(const Case& at, const RunOptions& options, Recorder& recorder, Progress&) {
  const MeshFrame ground(figures::level_ground(static_cast<float>(at.parameters.number("side"))));
  const auto context = open_context(options.renderer, 64, 64);
  if (at.parameters.text("part") == "fog") {
    measure_fog(at, ground, *context, recorder);
  } else {
    measure_border(at, ground, *context, recorder);
  }
}

}  // namespace

extern const Experiment kAir{"hybrid.air", "§4.2 and §4.4: fog, the sun in it, and the ground's border",
                             kSpecs, cases, measure};

}  // namespace terrabench::hybrid
