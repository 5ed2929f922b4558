// Water of "hybrid" (§3.4): the three passes over the scene, and the Fresnel term, "from the dot product of
// the normal of the water and light reflection vector": what water reflects at grazing and at normal view, in
// three readings of that vector, and in three of the term: Schlick's approximation, which the landscape uses,
// the product itself, and one minus the product.
#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <random>
#include <vector>

#include "experiments/cases.h"
#include "experiments/figures/mesh_frame.h"
#include "renderers/landscape/landscape.h"
#include "renderers/landscape/probe.h"

namespace terrabench::hybrid {
namespace {

// The first three are numbered as FresnelReading.
constexpr std::array<std::string_view, 5> kReadings{"view", "reflected", "light", "product",
                                                    "one-minus-product"};
const std::array kSpecs{
    choice("reading", kReadings,
           "the vector whose product with the water's normal is taken: towards the eye; the line of sight "
           "reflected by the water; the sun's light reflected by the water, as printed; or with the vector "
           "towards the eye the product itself as the term, and one minus the product"),
    ParameterSpec{"sun_height", 35.0, "°", "height of the sun", 0, 90},
};

std::vector<Case> cases(const RunOptions&) { return cases_by("reading", kSpecs); }

void measure(const Case& at, const RunOptions& options, Recorder& recorder, Progress&) {
  constexpr double kDegree = std::numbers::pi / 180;
  constexpr int kAngles = 90;
  constexpr double kGrazing = 88;  // degrees
  const auto reading = static_cast<float>(at.parameters.choice("reading"));
  const auto sun = static_cast<float>(at.parameters.number("sun_height") * kDegree);
  const auto input = [&](double degrees, double azimuth) {
    return glm::vec4(degrees * kDegree, sun, azimuth * kDegree, reading);
  };
  std::vector<glm::vec4> inputs{input(0, 0), input(kGrazing, 0)};
  for (int degrees = 0; degrees < kAngles; ++degrees) inputs.push_back(input(degrees, 60));
  const auto context = open_context(options.renderer, 64, 64);
  const std::vector<float> shares = evaluate(*context, Probe::kReflectance, inputs);
  recorder.add("reflectance_normal", "", shares[0]);
  recorder.add("reflectance_grazing", "", shares[1]);
  // Up to 15° the term is below a float's precision.
  constexpr std::size_t kFirst = 2 + 15;
  double rises = 0;
  for (std::size_t k = kFirst + 1; k < shares.size(); ++k) rises += shares[k] > shares[k - 1] ? 1 : 0;
  recorder.add("rising_share", "", rises / static_cast<double>(shares.size() - kFirst - 1));
}

constexpr ParameterSpec kPassSpecs[] = {
    {"points", std::int64_t{1000}, "", "random points around the water that are followed through the passes",
     1, 1e6},
};

std::vector<Case> pass_cases(const RunOptions&) { return {{"water", Parameters(kPassSpecs)}}; }

// How far apart two points lie in a picture, in pixels along the axis on which they differ most.
double pixels_apart(const glm::vec4& a, const glm::vec4& b, const View& view) {
  return 0.5 * std::max(view.width * std::abs(double{a.x} / a.w - double{b.x} / b.w),
                        view.height * std::abs(double{a.y} / a.w - double{b.y} / b.w));
}

bool in_picture(const glm::vec4& clip) {
  return clip.w > 0 && std::abs(clip.x) <= clip.w && std::abs(clip.y) <= clip.w && std::abs(clip.z) <= clip.w;
}

void measure_passes(const Case& at, const RunOptions& options, Recorder& recorder, Progress&) {
  constexpr float kSide = 400, kLevel = 40, kMargin = 1;  // metres
  const Parameters look(landscape_parameters(), {{"water", 0.4}, {"shadows", false}, {"occlusion", 0.0}});
  const auto context = open_context(options.renderer, 64, 64);
  LandscapeRenderer renderer(*context, make_style(look, {glm::vec3(0), {kSide, 100, kSide}}));
  std::vector<PassView> passes;
  renderer.also = [&](const PassView& pass) { passes.push_back(pass); };
  View view;
  view.eye = {200, 60, 380};
  view.target = {200, 40, 200};
  view.width = view.height = 64;
  const figures::MeshFrame ground(figures::level_ground(kSide));
  renderer.draw(ground.frame(), view);
  recorder.add("passes", "", static_cast<double>(passes.size()));
  if (passes.size() != 3) return;

  std::mt19937 random(static_cast<std::mt19937::result_type>(options.seed));
  std::uniform_real_distribution<float> across(0, kSide), apart(kMargin, 40);
  double mirrored = 0, upright = 0, shown = 0;
  std::array<double, 4> kept{};  // above and below the water, by the first and the second pass
  const auto points = at.integer("points");
  for (int k = 0; k < points; ++k) {
    const float x = across(random), z = across(random), up = apart(random);
    const glm::vec4 above(x, kLevel + up, z, 1), below(x, kLevel - up, z, 1);
    const glm::vec4 in_the_picture = passes[2].world_to_clip * below;
    if (in_picture(in_the_picture)) {
      ++shown;
      mirrored = std::max(mirrored, pixels_apart(passes[0].world_to_clip * above, in_the_picture, view));
      upright = std::max(upright, pixels_apart(passes[1].world_to_clip * below, in_the_picture, view));
    }
    for (std::size_t pass = 0; pass < 2; ++pass) {
      kept[2 * pass] += glm::dot(passes[pass].clip_plane, above) > 0;
      kept[2 * pass + 1] += glm::dot(passes[pass].clip_plane, below) > 0;
    }
  }
  recorder.add("points_shown", "", shown);
  recorder.add("first_off_mirrored", "pixels", mirrored);
  recorder.add("second_off_upright", "pixels", upright);
  recorder.add("first_keeps_above", "", kept[0] / points);
  recorder.add("first_keeps_below", "", kept[1] / points);
  recorder.add("second_keeps_above", "", kept[2] / points);
  recorder.add("second_keeps_below", "", kept[3] / points);
}

}  // namespace

extern const Experiment kWaterPasses{"hybrid.water-passes", "§3.4: the passes in which water is drawn",
                                     kPassSpecs, pass_cases, measure_passes};
extern const Experiment kFresnel{"hybrid.fresnel", "§3.4: reflectance of water in five readings", kSpecs,
                                 cases, measure};

}  // namespace terrabench::hybrid
