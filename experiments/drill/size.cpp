// The size of drills: the paper's count of values (§4.1) and true bytes, compared with other compressors of
// the same ground at the same error.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "experiments/drill/factorial.h"
#include "experiments/drill/ground.h"
#include "experiments/experiment.h"
#include "experiments/figures/maps.h"
#include "representations/drill/drill_codec.h"
#include "representations/drill/extract.h"
#include "representations/drill/quantum.h"
#include "representations/drill/regenerate.h"
#include "results/plot/plot.h"
#include "terrain/metrics/elevation_error.h"
#include "terrain/sources/dem/compressed_sizes.h"

namespace terrabench::drill {
namespace {

// The paper's 13,000 drills of 160,000 pixels.
constexpr double kPaperShare = 13000.0 / 160000.0;

struct Stored {
  Drills drills;
  std::size_t bytes = 0;
  ElevationError error;
};

// With drills rounded as in their file, and the k of least error.
Stored store(const Heightfield& ground, const FlowNetwork& network, const Variant& variant,
             std::uint32_t tau) {
  Stored stored{extract_drills(ground, network, options_for({.tau = tau}, variant)), 0, {}};
  quantise(stored.drills, automatic_quantum(ground));
  stored.error = choose_influence_of_all(ground, stored.drills);
  ByteSink bytes;
  encode_drills(stored.drills, bytes);
  stored.bytes = bytes.bytes().size();
  return stored;
}

// Numbers of a drill as integers: multiples of the quanta of the file, as stored, or whole metres, metres per
// sample and metres per sample².
void record_integers(const Heightfield& ground, const FlowNetwork& network, const Variant& variant,
                     std::uint32_t tau, const Drills& stored, Recorder& recorder) {
  Drills exact = extract_drills(ground, network, options_for({.tau = tau}, variant));
  Drills whole = exact;
  for (auto* const numbers : {&whole.elevation, &whole.slope, &whole.curvature}) {
    for (float& number : *numbers) number = std::round(number);
  }
  const double error = choose_influence_of_all(ground, exact).rmse;
  recorder.add("rmse_exact", "m", error);
  const double error_whole = choose_influence_of_all(ground, whole).rmse;
  recorder.add("rmse_whole", "m", error_whole);
  double largest = std::max(ground.width, ground.depth);  // of x and y
  const Quanta quanta(stored.quantum, stored.w);
  const auto include = [&](const std::vector<float>& values, double quantum) {
    for (const float value : values) largest = std::max(largest, std::abs(value / quantum));
  };
  include(stored.elevation, quanta.elevation);
  include(stored.slope, quanta.slope);
  include(stored.curvature, quanta.curvature);
  recorder.add("largest_integer", "", largest);
}

// The threshold whose number of channel pixels is nearest to `pixels`.
std::uint32_t threshold_for(const FlowNetwork& network, std::size_t pixels) {
  std::vector<std::uint32_t> flow = network.accumulation;
  pixels = std::clamp<std::size_t>(pixels, 1, flow.size());
  std::nth_element(flow.begin(), flow.begin() + static_cast<std::ptrdiff_t>(pixels) - 1, flow.end(),
                   std::greater<>());
  const std::uint32_t tau = std::max(flow[pixels - 1], 1U);
  // Where many flows are equal the count jumps; the next threshold may be nearer.
  const auto distance = [&](std::uint32_t t) {
    const auto count = std::count_if(flow.begin(), flow.end(), [=](std::uint32_t f) { return f >= t; });
    return std::abs(static_cast<double>(count) - static_cast<double>(pixels));
  };
  return distance(tau + 1) < distance(tau) ? tau + 1 : tau;
}

// The settings of each codec in the plot: quantisation steps in metres for zstd, percent for JPEG 2000,
// largest errors in metres for LERC.
struct Peer {
  RasterCodec codec;
  std::vector<double> settings;
};
const std::array kPeers{
    Peer{RasterCodec::kJpeg2000, {0.1, 0.3, 1, 3, 10, 30}},
    Peer{RasterCodec::kLercDeflate, {0.5, 2, 8, 32, 128}},
    Peer{RasterCodec::kLerc, {0.5, 2, 8, 32, 128}},
    Peer{RasterCodec::kZstdDifferences, {2, 8, 32, 128, 400}},
};

void add_point(PlotSeries& series, std::size_t bytes, std::size_t samples, double rmse) {
  series.points.push_back({8 * static_cast<double>(bytes) / static_cast<double>(samples), rmse, rmse, rmse});
}

void draw_rate_distortion(const TerrainSource& source, const FlowNetwork& network, const std::string& suffix,
                          Recorder& recorder, Progress& progress) {
  const Heightfield& ground = *source.heights;
  const std::size_t samples = ground.heights.size();
  Plot plot;
  plot.title = "Error against bits per sample";
  plot.x = {"bits per sample", "", true};
  plot.y = {"RMSE", "m", true};
  constexpr std::array kThresholds{10U, 25U, 50U, 100U, 200U, 400U, 800U};
  progress.begin("rate and distortion", kFits.size() * kThresholds.size() + kPeers.size());
  for (const Variant& variant : kFits) {
    PlotSeries& drills = plot.series.emplace_back();
    drills.label = fmt::format("drills, {}", variant.name);
    for (const std::uint32_t tau : kThresholds) {
      const Stored stored = store(ground, network, variant, tau);
      add_point(drills, stored.bytes, samples, stored.error.rmse);
      progress.advance();
    }
  }
  const Heightfield filled = fill_no_data(ground);
  for (const Peer& peer : kPeers) {
    PlotSeries& series = plot.series.emplace_back();
    series.label = name(peer.codec);
    for (const double setting : peer.settings) {
      const CompressedSize size = compressed_size(filled, peer.codec, setting);
      add_point(series, size.bytes, samples, size.rmse);
    }
    progress.advance();
  }
  // All codecs store flat ground without error, which a logarithmic axis cannot show.
  if (height_range(ground).lowest == height_range(ground).highest) return;
  figures::write_chart(
      recorder.figure(
          "drill.rate-distortion" + suffix,
          fmt::format("Bits per sample against error for {}: drills of each fit in their own file "
                      "format, with w = 10 and the best k at seven thresholds, "
                      "and the same ground in other codecs.",
                      source.name)),
      plot, 1200);
}

void measure(const Case& test_case, const RunOptions& options, Recorder& recorder, Progress& progress) {
  const TerrainSource source = recorder.terrain(open_ground(test_case.terrain, options.seed));
  const Heightfield& ground = *source.heights;
  const Variant& variant = variant_of(test_case.parameters);
  const FlowNetwork network = variant.route(ground);
  const auto samples = static_cast<double>(ground.heights.size());
  const auto wanted = static_cast<std::size_t>(std::lround(kPaperShare * samples));
  const std::uint32_t tau = threshold_for(network, wanted);
  const Stored stored = store(ground, network, variant, tau);
  const auto drills = static_cast<double>(stored.drills.count());
  recorder.add("drills", "", drills);
  recorder.add("drills_per_160000", "", drills * 160000 / samples);
  recorder.add("values_to_samples", "",
               static_cast<double>(values_per_drill(variant.fit)) * drills / samples);
  recorder.add("rmse", "m", stored.error.rmse);
  add_share(recorder, "rmse_normalised", stored.error.normalised());
  recorder.add("drill_bytes", "B", stored.bytes);
  record_integers(ground, network, variant, tau, stored.drills, recorder);
  // Whether so many drills are required: with a quarter of them.
  add_share(recorder, "quarter_rmse_normalised",
            store(ground, network, variant, threshold_for(network, wanted / 4)).error.normalised());
  // The other compressors do not support holes.
  const Heightfield filled = fill_no_data(ground);
  recorder.add("zstd_metres_bytes", "B", compressed_size(filled, RasterCodec::kZstd, 1).bytes);
  recorder.add("jpeg2000_lossless_bytes", "B", compressed_size(filled, RasterCodec::kJpeg2000, 100).bytes);
  for (const auto& [metric, codec] : {std::pair("zstd_bytes", RasterCodec::kZstdDifferences),
                                      {"jpeg2000_bytes", RasterCodec::kJpeg2000},
                                      {"lerc_bytes", RasterCodec::kLerc},
                                      {"lerc_deflate_bytes", RasterCodec::kLercDeflate}}) {
    recorder.add(metric, "B", compressed_size_at(filled, codec, stored.error.rmse).bytes);
  }
  if (variant.is_first())
    draw_rate_distortion(source, network, figures::ground_suffix(test_case.terrain, kMainGround), recorder,
                         progress);
}

}  // namespace

extern const Experiment kSize{"drill.size", "§4.1: values and bytes", variant_specs(), fit_cases, measure};

}  // namespace terrabench::drill
