// Every level-of-detail method at the same screen-space error along the same path: triangles, error, cracks,
// popping, times, bytes and pictures, all measured outside the methods.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <optional>

#include "experiments/cross/lod/tuned_cases.h"
#include "experiments/figures/maps.h"
#include "experiments/samples.h"
#include "experiments/stopwatch.h"
#include "lod/brute_force/brute_force.h"
#include "lod/meters/cracks.h"
#include "lod/meters/screen_error.h"
#include "renderers/frame_renderer.h"
#include "results/store/format.h"
#include "terrain/metrics/image_error.h"

namespace terrabench::cross {
namespace {

constexpr std::array kErrors{1.0, 2.0, 4.0};  // pixels
constexpr std::string_view kAll = "all";      // in place of a method

constexpr double kPanel = 400;  // units of the sheet
constexpr int kColumns = 3;
constexpr int kSky = 8;     // pixels kept above the horizon
constexpr int kWarmUp = 8;  // frames before the pictured one, for methods that keep a mesh between frames

// The first row that is not all background.
int horizon(const Image& image, Rgb background) {
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      if (image.pixel(x, y) != background) return y;
    }
  }
  return 0;
}

Image without_rows(const Image& image, int rows) {
  Image rest(image.width, image.height - rows, {});
  rest.rgb.assign(image.rgb.begin() + std::ptrdiff_t{3} * rows * image.width, image.rgb.end());
  return rest;
}

// Draws, and waits for the result. `wires`: width in pixels, 0 for none.
void draw_ground(FrameRenderer& renderer, const Flight& flight, const Frame& frame, const View& view,
                 float wires = 0) {
  renderer.draw(frame, view, {.lowest = flight.lowest, .highest = flight.highest, .wire_width = wires});
  renderer.finish();
}

// Draws the full terrain in the flight's pictured frames, once per flight.
void draw_reference(Flight& flight, GlContext& context, Progress& progress) {
  if (!flight.pictures.empty()) return;
  BruteForce full(flight.ground());
  FrameRenderer renderer(context);
  const std::vector<std::size_t> chosen = pictured(flight);
  progress.begin(fmt::format("drawing the full {}", flight.route.terrain), chosen.size());
  for (const std::size_t k : chosen) {
    const View& view = flight.views[flight.metered[k]];
    draw_ground(renderer, flight, full.update(view), view);
    flight.pictures.push_back(renderer.image());
    progress.advance();
  }
  progress.end();
}

constexpr Rgb kNear{230, 97, 0};

// Tints the pixels of triangles that belong to meshes in space, such as the hybrid's near surface: on a
// height field they are those of the clipmap that it replaces. Returns how many triangles are in these
// meshes.
std::size_t tint_meshes(const Frame& frame, const std::vector<std::uint32_t>& numbers, Image& image) {
  std::size_t of_heights = 0, of_meshes = 0;
  for (const Batch& batch : frame.batches) of_heights += batch.index_count / 3;
  for (const FrameMesh& mesh : frame.meshes) of_meshes += mesh.drawn ? mesh.triangles() : 0;
  for (std::size_t k = 0; k < numbers.size(); ++k) {
    if (numbers[k] <= of_heights) continue;
    for (std::size_t c = 0; c < 3; ++c) {
      std::uint8_t& channel = image.rgb[3 * k + c];
      channel = static_cast<std::uint8_t>((channel + kNear[c]) / 2);
    }
  }
  return of_meshes;
}

// The figure of one ground: every method's triangles in the same view halfway along the path, each method
// tuned to `pixels`.
void draw_wires(Flight& flight, double pixels, const std::string& options, GlContext& context,
                Recorder& recorder, Progress& progress) {
  // Halfway along the path, where it is close to the ground.
  const std::size_t last = flight.metered[flight.metered.size() / 2];
  const View& view = flight.views[last];
  std::vector<figures::Panel> panels;
  int sky = view.height;
  for (const LodType& type : lods()) {
    const ConfiguredMethod method = configured(type.name, options);
    const Tuned tuned = tune_to(flight, method, pixels, progress);
    const std::unique_ptr<Lod> lod = method.build(flight.ground(), progress);
    lod->tune(tuned.knob);
    for (std::size_t i = last > kWarmUp ? last - kWarmUp : 0; i < last; ++i) lod->update(flight.views[i]);
    const Frame& frame = lod->update(view);
    FrameRenderer renderer(context);
    draw_ground(renderer, flight, frame, view, 1);
    const auto triangles = static_cast<double>(frame.stats.triangles);
    Image image = renderer.image();
    const std::size_t near = tint_meshes(frame, FrameRenderer(context).triangle_numbers(frame, view), image);
    panels.push_back({std::move(image),
                      fmt::format("({:c}) {}: {} triangles{}", 'a' + static_cast<int>(panels.size()),
                                  type.label, format_number(triangles),
                                  near == 0 ? "" : fmt::format(", {} of them near", format_count(near)))});
    sky = std::min(sky, std::max(0, horizon(panels.back().image, FrameStyle{}.background) - kSky));
    recorder.add(fmt::format("{}_triangles", type.name), "", triangles);
  }
  for (figures::Panel& panel : panels) panel.image = without_rows(panel.image, sky);
  const figures::Sheet sheet = figures::titled_sheet(kColumns, kPanel, 14, panels);
  const std::string suffix = figures::ground_suffix(flight.route.terrain, kMainGround);
  sheet.write(recorder.figure(
      "cross.lod-wires" + suffix,
      fmt::format(
          "{}: every method's triangles in the same view, each tuned to {:g} px at the 99th "
          "percentile over the path {}; colours by height from {:.0f} to {:.0f} m, and orange for the "
          "near surface that the hybrid puts in the place of the clipmap's centre",
          flight.source.name, pixels, flight.route.path, flight.lowest, flight.highest)));
}

void measure_cost(const Flight& flight, const ConfiguredMethod& method, double knob, Recorder& recorder,
                  Progress& progress) {
  PathCost cost = fly(flight, method, knob, progress);
  recorder.add("first_uploaded", "B", cost.first_uploaded);
  recorder.add("bytes_held", "B", cost.bytes_held);
  recorder.add_varying("heap_growth", "B", cost.heap_growth);
  recorder.add("uploaded", "B", cost.uploaded);
  for (const double t : cost.times) recorder.add_frame("update_time", "s", t);
  for (const double t : cost.triangles) recorder.add_frame("triangles", "", t);
  std::sort(cost.times.begin(), cost.times.end());
  recorder.add("update_time_p99", "s", cost.times[(99 * cost.times.size() + 99) / 100 - 1]);
}

// Results over the metered frames.
struct Shown {
  Distribution error, popping;  // of visible samples, pixels
  double largest_anywhere = 0;  // error of any sample in the frustum, hidden ones included; pixels
  std::size_t undrawn = 0, cracks = 0;
  // Seconds, with the upload, of which meshes in space are sent with the first only: sums over the pictures.
  std::array<double, kSamples> frame_times{};
  std::vector<double> noise;  // per picture: mean squared error, as a share of the squared peak
  std::vector<double> ssim;
};

void meter(const Flight& flight, std::size_t k, const Frame& frame, const SurfaceRaster& before,
           const SurfaceRaster& drawn, Shown& shown) {
  const Heightfield& ground = flight.ground();
  const SeenSamples& seen = flight.seen[k];
  const ScreenDeviation error = screen_error(drawn, ground, seen, &shown.error);
  shown.largest_anywhere = std::max(shown.largest_anywhere, error.in_frustum.largest);
  shown.undrawn += error.visible.undrawn;
  popping(before, drawn, seen, &shown.popping);
  const CrackReport cracks = find_cracks(frame, ground.width, ground.depth, seen.view());
  shown.cracks += cracks.gaps + cracks.bare_edges + cracks.overlaps + cracks.covered_again + cracks.flipped;
}

// Popping compares a frame with the one before, and its upload starts from there. A few frames of the path
// lead up to both, so that methods that keep a mesh between frames are in their usual state.
Shown measure_shown(Flight& flight, const ConfiguredMethod& method, double knob, GlContext& context,
                    Progress& progress) {
  constexpr std::size_t kLead = 3;
  Shown shown;
  const std::unique_ptr<Lod> lod = method.build(flight.ground(), progress);
  lod->tune(knob);
  SurfaceRaster before(flight.ground().width, flight.ground().depth), drawn = before;
  const std::vector<std::size_t> with_picture = pictured(flight);
  progress.begin(fmt::format("metering {} on {}", method.type->name, flight.route.terrain),
                 flight.metered.size());
  for (std::size_t k = 0; k < flight.metered.size(); ++k) {
    const std::size_t last = flight.metered[k];
    for (std::size_t i = last - std::min(last, kLead); i + 1 < last; ++i) lod->update(flight.views[i]);
    const Frame& former = lod->update(flight.views[last - 1]);
    before.draw(former);
    const auto picture = std::find(with_picture.begin(), with_picture.end(), k);
    std::optional<FrameRenderer> renderer;
    if (picture != with_picture.end()) {
      draw_ground(renderer.emplace(context), flight, former, flight.views[last - 1]);
    }
    const Frame& frame = lod->update(flight.views[last]);
    drawn.draw(frame);
    meter(flight, k, frame, before, drawn, shown);
    if (renderer) {
      for (double& sum : shown.frame_times) {
        const Stopwatch watch;
        draw_ground(*renderer, flight, frame, flight.views[last]);
        sum += watch.seconds();
      }
      const Image image = renderer->image(), &reference = flight.pictures[picture - with_picture.begin()];
      shown.noise.push_back(std::pow(10, -psnr(image, reference) / 10));
      shown.ssim.push_back(ssim(image, reference));
    }
    progress.advance();
  }
  progress.end();
  return shown;
}

void record(const Shown& shown, Recorder& recorder) {
  recorder.add("error_p99", "px", shown.error.quantile(0.99));
  recorder.add("error_mean", "px", shown.error.mean());
  recorder.add("error_largest", "px", shown.error.largest());
  recorder.add("popping_p99", "px", shown.popping.quantile(0.99));
  recorder.add("popping_largest", "px", shown.popping.largest());
  recorder.add("samples", "", shown.error.samples());
  recorder.add("undrawn_samples", "", shown.undrawn);
  recorder.add("cracks", "", shown.cracks);
  for (const double sum : shown.frame_times)
    recorder.add("frame_time", "s", sum / static_cast<double>(shown.ssim.size()));
  for (const double s : shown.ssim) recorder.add("ssim", "", s);
  // Over all pictures together; identical pictures have no signal-to-noise ratio.
  const double noise = std::accumulate(shown.noise.begin(), shown.noise.end(), 0.0);
  if (noise > 0)
    recorder.add("psnr", "dB", -10 * std::log10(noise / static_cast<double>(shown.noise.size())));
}

std::vector<Case> cases(const RunOptions& options) {
  const bool paper = options.profile == Profile::kPaper;
  std::vector<Case> cases;
  for (const std::string& terrain : compared_grounds(options)) {
    const bool large = paper && terrain == "fractal";
    const std::int64_t frames = large ? 12 : paper ? 48 : 12, size = large ? 4097 : paper ? 1025 : 257;
    const auto add = [&](const std::string& name, const Entrant& entrant, double error) {
      cases.push_back({fmt::format("{}/{}", terrain, name),
                       {kTunedSpecs,
                        {{"method", entrant.name},
                         {"error", error},
                         {"path", path_over(terrain)},
                         {"frames", frames},
                         {"size", size}}},
                       terrain});
    };
    for (const Entrant& entrant : entrants()) {
      if (!configured(entrant.method, entrant.options).tunable()) {
        add(entrant.name, entrant, kErrors.front());
        continue;
      }
      for (const double error : kErrors) {
        add(fmt::format("{}/{:.0f}px", entrant.name, error), entrant, error);
      }
    }
    add("wires", {std::string(kAll), "", ""}, kErrors[1]);
  }
  return cases;
}

void measure(const Case& at, const RunOptions& options, Recorder& recorder, Progress& progress) {
  Flight& flight = flight_of(at, options, recorder, progress);
  const double pixels = at.parameters.number("error");
  const std::string& method = at.parameters.text("method");
  const auto context = open_context(options.renderer, flight.views[0].width, flight.views[0].height);
  if (method == kAll) {
    draw_wires(flight, pixels, at.parameters.text("options"), *context, recorder, progress);
    return;
  }
  const ConfiguredMethod measured = named_method(method, at.parameters.text("options"));
  const Tuned tuned = tune_to(flight, measured, pixels, progress);
  recorder.add("knob", "", tuned.knob);
  recorder.add("reached", "", tuned.reached ? 1 : 0);
  measure_cost(flight, measured, tuned.knob, recorder, progress);
  draw_reference(flight, *context, progress);
  const Shown shown = measure_shown(flight, measured, tuned.knob, *context, progress);
  record(shown, recorder);
  recorder.add("error_of_asked", "", shown.error.quantile(0.99) / pixels);
  // For methods whose knob bounds the error: the largest error of a sample in the frustum, relative to the
  // bound.
  if (measured.type->traits.bounds_error)
    recorder.add("bound_taken", "", shown.largest_anywhere / tuned.knob);
}

}  // namespace

extern const Experiment kLodEqualError{"cross.lod-equal-error",
                                       "Level-of-detail methods at the same screen-space error",
                                       kTunedSpecs,
                                       cases,
                                       measure,
                                       Experiment::kTimed};

}  // namespace terrabench::cross
