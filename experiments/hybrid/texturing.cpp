// §4.1 of "hybrid": textures by bands of height, and rock on steep ground. Tiles of known height and slope
// are drawn from above with one plain colour per material, and the picture's colours counted.
#include <array>
#include <cmath>
#include <glm/trigonometric.hpp>
#include <glm/vec2.hpp>
#include <numbers>
#include <string>
#include <vector>

#include "experiments/cases.h"
#include "experiments/figures/mesh_frame.h"
#include "experiments/figures/projection.h"
#include "experiments/hybrid/pixels.h"
#include "renderers/landscape/landscape.h"

namespace terrabench::hybrid {
namespace {

constexpr std::array<std::string_view, 2> kAngles{"printed", "true"};
const std::array kSpecs{
    choice("angle", kAngles, "of the ground: (1 - n_y)·90°, as printed, or acos(n_y)"),
    ParameterSpec{"steep", 30.0, "degrees", "angle from which ground is rock", 1, 89},
};

std::vector<Case> cases(const RunOptions&) { return cases_by("angle", kSpecs); }

constexpr int kBands = kMaterials, kSlopes = 41;             // slopes 0°, 2°, … 80°
constexpr float kBandHeight = 200, kTile = 10, kApart = 30;  // metres

float degrees_of(int slope) { return 2.0F * static_cast<float>(slope); }

// In the middle of its band's height.
glm::vec3 middle(int band, int slope) {
  return {kApart * (static_cast<float>(slope) + 0.5F), kBandHeight * (static_cast<float>(band) + 0.5F),
          kApart * (static_cast<float>(band) + 0.5F)};
}

TriangleMesh tiles() {
  TriangleMesh mesh;
  for (int band = 0; band < kBands; ++band) {
    for (int slope = 0; slope < kSlopes; ++slope) {
      const float angle = glm::radians(degrees_of(slope)), half = kTile / 2, rise = half * std::tan(angle);
      const auto first = static_cast<std::uint32_t>(mesh.positions.size());
      for (const auto& [x, z] : {std::pair{-1.0F, -1.0F}, {-1.0F, 1.0F}, {1.0F, -1.0F}, {1.0F, 1.0F}}) {
        mesh.positions.push_back(middle(band, slope) + glm::vec3(half * x, rise * x, half * z));
        mesh.normals.emplace_back(-std::sin(angle), std::cos(angle), 0);
      }
      for (const std::uint32_t k : {0U, 1U, 2U, 2U, 1U, 3U}) mesh.indices.push_back(first + k);
    }
  }
  return mesh;
}

// From so high that all tiles are seen nearly from straight above.
View from_above() {
  View view;
  view.target = {kApart * kSlopes / 2.0F, 0, kApart * kBands / 2.0F};
  view.eye = view.target + glm::vec3(0, 6000, 0);
  view.up = {0, 0, -1};
  view.width = 1640;
  view.height = 260;
  view.vertical_fov = 0.044F;
  view.near = 100;
  view.far = 7000;
  return view;
}

// Each material in a colour of its own, in even light without fog.
LandscapeStyle plain_style(const Case& at) {
  const Parameters look(landscape_parameters(), {{"slope_rule", at.parameters.text("angle")},
                                                 {"steep", at.parameters.number("steep")},
                                                 {"sand_top", 0.2},
                                                 {"grass_top", 0.4},
                                                 {"earth_top", 0.6},
                                                 {"rock_top", 0.8},
                                                 {"band_blend", 0.01},
                                                 {"sand_color", std::string("#ff0000")},
                                                 {"grass_color", std::string("#00ff00")},
                                                 {"earth_color", std::string("#0000ff")},
                                                 {"rock_color", std::string("#ffff00")},
                                                 {"snow_color", std::string("#ff00ff")},
                                                 {"sun_strength", 0.0},
                                                 {"sky_low", std::string("#808080")},
                                                 {"sky_high", std::string("#808080")},
                                                 {"shadows", false},
                                                 {"occlusion", 0.0},
                                                 {"water", 0.0},
                                                 {"fog", 1000.0},
                                                 {"border", 0.0},
                                                 {"bumps", 0.0}});
  return make_style(look, {glm::vec3(0), {kApart * kSlopes, kBandHeight * kBands, kApart * kBands}});
}

// The material whose colour a pixel has, by which of its channels are above half of the brightest.
enum class Seen : std::uint8_t { kSand = 1, kGrass = 2, kEarth = 4, kRock = 3, kSnow = 5 };
constexpr std::array kOfBand{Seen::kSand, Seen::kGrass, Seen::kEarth, Seen::kRock, Seen::kSnow};

Seen seen(const Rgb& pixel) {
  const std::array light{light_of(pixel[0]), light_of(pixel[1]), light_of(pixel[2])};
  const double half = 0.5 * *std::max_element(light.begin(), light.end());
  int channels = 0;
  for (int c = 0; c < 3; ++c) channels |= light[static_cast<std::size_t>(c)] > half ? 1 << c : 0;
  return static_cast<Seen>(channels);
}

// The share of a tile's pixels, without its border, that show the material.
double share(const Image& image, const View& view, int band, int slope, Seen material) {
  const glm::dvec2 at = figures::pixel_of(view, middle(band, slope));
  const int x = static_cast<int>(at.x), y = static_cast<int>(at.y);
  constexpr int kReach = 3;  // pixels; a tile has 10 or more
  int of_material = 0, all = 0;
  for (int dy = -kReach; dy <= kReach; ++dy) {
    for (int dx = -kReach; dx <= kReach; ++dx, ++all)
      of_material += seen(image.pixel(x + dx, y + dy)) == material;
  }
  return static_cast<double>(of_material) / all;
}

void measure(const Case& at, const RunOptions& options, Recorder& recorder, Progress&) {
  constexpr int kLevel = 5, kSteep = 35;  // slopes up to 10°, and from 70° on
  const figures::MeshFrame ground(tiles());
  const View view = from_above();
  const auto context = open_context(options.renderer, view.width, view.height);
  LandscapeRenderer renderer(*context, plain_style(at));
  renderer.draw(ground.frame(), view);
  const Image image = renderer.image();

  double own = 1, rock = 1;  // the least shares
  for (int band = 0; band < kBands; ++band) {
    for (int slope = 0; slope <= kLevel; ++slope)
      own = std::min(own, share(image, view, band, slope, kOfBand[static_cast<std::size_t>(band)]));
    for (int slope = kSteep; slope < kSlopes; ++slope)
      rock = std::min(rock, share(image, view, band, slope, Seen::kRock));
  }
  // The true angle at which half of the pixels of all bands but rock's own are rock: slopes below it,
  // counted.
  double below = 0;
  for (int slope = 0; slope < kSlopes; ++slope) {
    for (const int band : {0, 1, 2, 4}) below += 2.0 * (1 - share(image, view, band, slope, Seen::kRock)) / 4;
  }
  const double from = below - 1, cosine = std::cos(from * std::numbers::pi / 180);
  recorder.add("level_ground_of_its_band", "", own);
  recorder.add("steep_ground_of_rock", "", rock);
  recorder.add("rock_from_true_angle", "degrees", from);
  recorder.add("rock_from_printed_angle", "degrees", (1 - cosine) * 90);
}

}  // namespace

extern const Experiment kTexturing{
    "hybrid.texturing", "§4.1: textures by height and slope, counted in a picture", kSpecs, cases, measure};

}  // namespace terrabench::hybrid
