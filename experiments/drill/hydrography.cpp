// How well drills keep the channels of the ground (the drill paper's §4: "hydrography information is well
// maintained", better than by traditional representations): channels of the regenerated terrain against those
// of the original, beside a height field of as many values, and beside drills at random pixels.
#include <algorithm>
#include <cmath>
#include <random>

#include "experiments/drill/factorial.h"
#include "experiments/drill/ground.h"
#include "experiments/experiment.h"
#include "representations/drill/regenerate.h"
#include "terrain/hydrology/channels.h"
#include "terrain/metrics/elevation_error.h"

namespace terrabench::drill {
namespace {

constexpr std::uint32_t kChannelTau = 100;  // channels that are compared: the paper's second threshold

// The share of pixels of `some` with one of `others` among their nine nearest.
double share_near(const std::vector<std::uint32_t>& some, const std::vector<std::uint32_t>& others, int width,
                  int depth) {
  std::vector<bool> near(static_cast<std::size_t>(width) * static_cast<std::size_t>(depth));
  for (const std::uint32_t pixel : others) {
    const int x = static_cast<int>(pixel) % width, z = static_cast<int>(pixel) / width;
    for (int j = std::max(0, z - 1); j <= std::min(depth - 1, z + 1); ++j) {
      for (int i = std::max(0, x - 1); i <= std::min(width - 1, x + 1); ++i) {
        near[static_cast<std::size_t>(j) * static_cast<std::size_t>(width) + static_cast<std::size_t>(i)] =
            true;
      }
    }
  }
  const auto count = std::ranges::count_if(some, [&](std::uint32_t pixel) { return near[pixel]; });
  return static_cast<double>(count) / static_cast<double>(some.size());
}

class Channels {
 public:
  Channels(const Heightfield& ground, const FlowNetwork& network)
      : ground_(ground), own_(channel_pixels(network, kChannelTau)) {}

  // Of the ground's channel pixels and of the other terrain's, the share within a sample of one of the other
  // set, the smaller of the two; and equation 3's distance, in samples.
  void record(const Heightfield& other, const std::string& prefix, Recorder& recorder) const {
    const std::vector<std::uint32_t> found = channel_pixels(route_flow(other), kChannelTau);
    add_share(recorder, prefix + "kept_share",
              std::min(share_near(own_, found, ground_.width, ground_.depth),
                       share_near(found, own_, ground_.width, ground_.depth)));
    const double distance =
        channel_distance(ground_, own_, other, found, ChannelSpace::kPlaneSamples).hausdorff();
    if (std::isfinite(distance)) recorder.add(prefix + "channel_distance", "samples", distance);
    add_share(recorder, prefix + "rmse_normalised", elevation_error(ground_, other).normalised());
  }

 private:
  const Heightfield& ground_;
  std::vector<std::uint32_t> own_;
};

Heightfield regenerated_at_best_k(const Heightfield& ground, Drills drills) {
  choose_influence_of_all(ground, drills);
  return regenerate(drills);
}

// A height field of `values` samples, drawn at the ground's size.
Heightfield coarse(const Heightfield& ground, std::size_t values) {
  const double scale = std::sqrt(static_cast<double>(values) / static_cast<double>(ground.heights.size()));
  const auto of = [&](int samples) {
    return std::clamp(static_cast<int>(std::lround(samples * scale)), 2, samples);
  };
  return resample(resample(ground, of(ground.width), of(ground.depth)), ground.width, ground.depth);
}

// As many drills at random pixels with data: a network whose flow is τ there and 1 elsewhere.
FlowNetwork scattered(FlowNetwork network, std::size_t count, std::uint32_t tau, std::uint64_t seed) {
  std::vector<std::uint32_t> pixels;
  for (std::size_t i = 0; i < network.size(); ++i) {
    if (network.direction[i] != FlowNetwork::kNoData) pixels.push_back(static_cast<std::uint32_t>(i));
  }
  std::mt19937_64 random(seed);
  // std::shuffle differs between standard libraries.
  for (std::size_t i = pixels.size(); i > 1; --i) std::swap(pixels[i - 1], pixels[random() % i]);
  for (const std::uint32_t pixel : pixels) network.accumulation[pixel] = 1;
  for (std::size_t i = 0; i < std::min(count, pixels.size()); ++i) network.accumulation[pixels[i]] = tau;
  return network;
}

void measure(const Case& test_case, const RunOptions& options, Recorder& recorder, Progress& progress) {
  const TerrainSource source = recorder.terrain(open_ground(test_case.terrain, options.seed));
  const Heightfield& ground = *source.heights;
  const Variant& variant = variant_of(test_case.parameters);
  const FlowNetwork network = variant.route(ground);
  const Setting setting;
  const Drills drills = extract_drills(ground, network, options_for(setting, variant), &progress);
  if (channel_pixels(network, kChannelTau).empty()) throw SkippedCase("no channel of 100 pixels' flow");
  const Channels channels(ground, network);
  channels.record(regenerated_at_best_k(ground, drills), "", recorder);
  channels.record(coarse(ground, values_per_drill(variant.fit) * drills.count()), "coarse_", recorder);
  const FlowNetwork elsewhere = scattered(network, drills.count(), setting.tau, options.seed);
  channels.record(
      regenerated_at_best_k(ground, extract_drills(ground, elsewhere, options_for(setting, variant))),
      "scattered_", recorder);
}

}  // namespace

extern const Experiment kHydrography{"drill.hydrography", "§4: channels of the regenerated terrain",
                                     variant_specs(), fit_cases, measure};

}  // namespace terrabench::drill
