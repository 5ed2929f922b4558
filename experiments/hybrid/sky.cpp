// The sky of "hybrid" (§4.3): the blend of sky and cloud as the shader computes it, and the seam of the noise
// map.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "experiments/experiment.h"
#include "experiments/hybrid/landscape_measures.h"
#include "renderers/landscape/landscape.h"
#include "renderers/landscape/probe.h"

namespace terrabench::hybrid {
namespace {

constexpr ParameterSpec kSpecs[] = {
    {"width", std::int64_t{2048}, "texels", "width of the noise map", 16, 8192},
    {"height", std::int64_t{768}, "texels", "height of the noise map", 16, 8192},
    {"samples", std::int64_t{1001}, "", "intensities at which the blend is evaluated", 3, 16384},
};

std::vector<Case> cases(const RunOptions&) { return {{"sky", Parameters(kSpecs)}}; }

// Against the printed formula in double precision.
void measure_blend(GlContext& context, int samples, Recorder& recorder) {
  std::vector<glm::vec4> intensities;
  for (int k = 0; k < samples; ++k) {
    intensities.emplace_back(static_cast<float>(k) / static_cast<float>(samples - 1), 0, 0, 0);
  }
  const std::vector<float> shares = evaluate(context, Probe::kSkyShare, intensities);
  double largest = 0;
  for (std::size_t k = 0; k < shares.size(); ++k) {
    const double printed = (std::cos(double{intensities[k].x} * std::numbers::pi) + 1) / 2;
    largest = std::max(largest, std::abs(shares[k] - printed));
  }
  recorder.add("sky_share_without_cloud", "", shares.front());
  recorder.add("sky_share_of_full_cloud", "", shares.back());
  recorder.add("largest_difference", "", largest);
}

void measure_map(const Texels& map, Recorder& recorder) {
  const Seam seam = measure_seam(map);
  recorder.add("seam_step", "", seam.at_seam);
  recorder.add("largest_step", "", seam.elsewhere);
  const auto [least, most] = std::minmax_element(map.values.begin(), map.values.begin() + map.width);
  recorder.add("zenith_spread", "", *most - *least);
}

// The mean difference between neighbouring columns of pixels.
std::vector<double> column_steps(const Image& image) {
  std::vector<double> steps;
  for (int x = 0; x + 1 < image.width; ++x) {
    double sum = 0;
    for (int y = 0; y < image.height; ++y) {
      const Rgb a = image.pixel(x, y), b = image.pixel(x + 1, y);
      for (int c = 0; c < 3; ++c) sum += std::abs(int{a[c]} - b[c]);
    }
    steps.push_back(sum / (3.0 * image.height));
  }
  return steps;
}

// Where the map's first and last column meet, and opposite, where the azimuth jumps by a turn: the step in
// the middle of the picture as a share of the largest elsewhere.
double picture_seam(LandscapeRenderer& renderer, float north) {
  View view;
  view.width = 401;
  view.height = 300;
  view.eye = glm::vec3(0);
  view.target = {0, 0.6F, -north};
  renderer.draw({}, view);
  std::vector<double> steps = column_steps(renderer.image());
  // The middle column of 401 contains the seam.
  const double seam = std::max(steps[199], steps[200]);
  steps.erase(steps.begin() + 199, steps.begin() + 201);
  return seam / *std::max_element(steps.begin(), steps.end());
}

void measure(const Case& at, const RunOptions& options, Recorder& recorder, Progress&) {
  const auto context = open_context(options.renderer, 64, 64);
  measure_blend(*context, at.integer("samples"), recorder);
  measure_map(sky_noise(at.integer("width"), at.integer("height"), options.seed, 1), recorder);
  const Parameters look(landscape_parameters(), {{"water", 0.0},
                                                 {"shadows", false},
                                                 {"occlusion", 0.0},
                                                 {"texture_seed", static_cast<std::int64_t>(options.seed)}});
  LandscapeRenderer renderer(*context, make_style(look, {glm::vec3(0), glm::vec3(1000)}));
  recorder.add("seam_share", "", picture_seam(renderer, 1));
  recorder.add("opposite_share", "", picture_seam(renderer, -1));
}

}  // namespace

extern const Experiment kSky{"hybrid.sky", "§4.3: the blend of sky and clouds, and the noise map's seam",
                             kSpecs, cases, measure};

}  // namespace terrabench::hybrid
