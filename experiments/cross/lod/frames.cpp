// What a whole frame costs at the same screen-space error, against the size of the ground: every method draws
// the same frames of one path on one renderer, and brute force beside them.
//
// Each method is tuned as in cross.lod-equal-error, at every size anew, on the processor: over every other
// metered frame (Flight::metered), of which there are few, since a try visits all samples of the ground in
// each. These frames are also the ones that are timed; the error that is recorded is over all metered ones.
// A repetition draws all frames by all methods, one method after the other, so that a slow period of the
// machine affects all alike; ratios are taken within a repetition. Sizes are tried in ascending order while
// the time lasts (SizePlan): a processor that draws ends at some millions of samples, a GPU does not.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <memory>

#include "experiments/cross/lod/frame_cost.h"
#include "experiments/cross/lod/tuned_cases.h"
#include "experiments/cross/scale/scaling.h"
#include "experiments/ground.h"
#include "experiments/samples.h"
#include "experiments/stopwatch.h"
#include "results/store/power_law.h"
#include "results/store/statistics.h"
#include "terrain/error.h"
#include "terrain/machine_error.h"
#include "terrain/memory.h"
#include "terrain/sources/catalogue.h"

namespace terrabench::cross {
namespace {

constexpr std::string_view kGrowing = "fractal", kReference = "brute_force";

const std::array kSpecs{
    ParameterSpec{"options", std::string(), "", "options of methods, such as geomipmap.patch=32"},
    ParameterSpec{"error", 2.0, "px", "required 99th percentile of the screen-space error", 0.01, 1000},
    ParameterSpec{"path", std::string("low"), "", "camera path: cross, fly, low, turn, walk, or a TOML file"},
    ParameterSpec{"frames", std::int64_t{4}, "", "frames of the path that are metered; half are timed", 1,
                  1000},
    ParameterSpec{"smallest", std::int64_t{257}, "samples", "side of the smallest fractal or mosaic, 2^n + 1",
                  3, 16385},
    ParameterSpec{"largest", std::int64_t{513}, "samples",
                  "side of the largest fractal or mosaic, or of another generated ground", 3, 16385},
    ParameterSpec{"seconds", 480.0, "s", "for all sizes; a size that would exceed it is skipped", 0, 1e6},
};

// Whether a ground is measured at several sizes.
bool grows(std::string_view terrain) { return terrain == kGrowing || terrain == kHelensMosaic; }

// One method at one size.
struct Measured {
  std::string name;    // of the method
  std::string prefix;  // of its metrics
  MethodFrames frames;
};

// By size, in ascending order.
struct Curve {
  std::vector<double> samples, draw, of_brute;  // medians; of_brute: whole frame ÷ that of brute force
};
using Curves = std::map<std::string, Curve, std::less<>>;

// Tuned, with its first frame on the GPU. Records its knob and its error; nothing, and records that it was
// refused, where memory or the renderer has no room for it.
std::unique_ptr<Measured> prepare(const LodType& type, Flight& flight, const Case& at, const std::string& key,
                                  GlContext& context, Recorder& recorder, Progress& progress) {
  const ConfiguredMethod method = configured(type.name, at.parameters.text("options"));
  const std::string prefix = fmt::format("{}{}_", type.name, key);
  const double pixels = at.parameters.number("error");
  std::unique_ptr<Measured> measured;
  Tuned tuned;
  double error = 0;
  try {
    tuned = tune_to(flight, method, pixels, progress);
    std::unique_ptr<Lod> lod = method.build(flight.ground(), progress);
    lod->tune(tuned.knob);
    error = errors_along(flight, *lod).quantile(0.99);
    // From here on each update is sent to the GPU: dirty ranges count from the update before.
    measured.reset(new Measured{std::string(type.name), prefix, {flight, std::move(lod), context}});
  } catch (const SkippedCase&) {
    recorder.add_varying(prefix + "refused", "", 1);
    return nullptr;
  } catch (const MachineError&) {
    throw;
  } catch (const Error& error) {
    if (error.code() != ExitCode::kEnvironment) throw;
    recorder.add_varying(prefix + "refused", "", 1);
    return nullptr;
  }
  recorder.add(prefix + "knob", "", tuned.knob);
  recorder.add(prefix + "error", "px", error);
  recorder.add(prefix + "reached", "", tuned.reached || !method.tunable() ? 1 : 0);
  if (method.tunable()) {
    recorder.add(prefix + "error_of_asked", "", error / pixels);
  }
  return measured;
}

// Seconds of one repetition: FrameCost of each method, in turn.
std::vector<double> repetition(std::vector<std::unique_ptr<Measured>>& methods,
                               const std::vector<std::size_t>& frames) {
  std::vector<double> all;
  for (const auto& method : methods) {
    const FrameCost cost = method->frames.fly(frames);
    for (const double one : {cost.choose, cost.send, cost.draw, cost.parts(), cost.whole}) all.push_back(one);
  }
  return all;
}

// Records the repetitions, and adds their medians to the curves.
void record(const std::vector<std::vector<double>>& repetitions,
            const std::vector<std::unique_ptr<Measured>>& methods, double samples, Recorder& recorder,
            Curves& curves) {
  constexpr std::array kTimes{"choose", "send", "draw", "sum", "frame"};
  constexpr std::size_t kDraw = 2, kFrame = 4;
  const auto brute = std::ranges::find(methods, kReference, [](const auto& m) { return m->name; });
  const std::size_t reference = kTimes.size() * static_cast<std::size_t>(brute - methods.begin()) + kFrame;
  for (std::size_t m = 0; m < methods.size(); ++m) {
    const std::size_t first = kTimes.size() * m;
    std::vector<double> draw, of_brute;
    for (const std::vector<double>& one : repetitions) {
      for (std::size_t t = 0; t < kTimes.size(); ++t) {
        recorder.add(methods[m]->prefix + kTimes[t], "s", one[first + t]);
      }
      draw.push_back(one[first + kDraw]);
      if (brute != methods.end()) of_brute.push_back(one[first + kFrame] / one[reference]);
    }
    for (const double ratio : of_brute) recorder.add_varying(methods[m]->prefix + "of_brute", "", ratio);
    if (of_brute.empty()) continue;
    Curve& curve = curves[methods[m]->name];
    curve.samples.push_back(samples);
    curve.draw.push_back(median(draw));
    curve.of_brute.push_back(median(of_brute));
  }
}

// All methods over one ground. `key` ends the names of its metrics.
void measure_ground(Flight& flight, const Case& at, const std::string& key, GlContext& context,
                    Recorder& recorder, Progress& progress, Curves& curves) {
  std::vector<std::unique_ptr<Measured>> methods;
  for (const LodType& type : lods()) {
    if (auto one = prepare(type, flight, at, key, context, recorder, progress)) {
      methods.push_back(std::move(one));
    }
  }
  std::vector<std::size_t> timed;
  for (std::size_t k = 0; k < flight.metered.size(); k += 2) timed.push_back(flight.metered[k]);
  progress.begin(fmt::format("drawing {} by {} methods", flight.source.name, methods.size()), kSamples + 1);
  repetition(methods, timed);  // warms up
  for (const auto& method : methods) {
    recorder.add(method->prefix + "triangles", "", method->frames.triangles());
    recorder.add(method->prefix + "sent", "B", method->frames.bytes_sent());
  }
  std::vector<std::vector<double>> repetitions;
  for (int k = 0; k < kSamples; ++k) {
    progress.advance();
    repetitions.push_back(repetition(methods, timed));
  }
  progress.end();
  const Heightfield& ground = flight.ground();
  record(repetitions, methods, static_cast<double>(ground.width) * ground.depth, recorder, curves);
}

// What the sizes show together: they depend on how many sizes the time allows, so all varies.
void record_growth(const Curves& curves, Recorder& recorder) {
  for (const auto& [name, curve] : curves) {
    if (const auto law = fit_power_law(curve.samples, curve.draw)) {
      recorder.add(name + "_draw_exponent", "exponent", law->exponent);
    }
    if (name == kReference) continue;
    for (std::size_t k = 0; k < curve.samples.size(); ++k) {
      recorder.add_varying(name + "_ratios", "", curve.of_brute[k]);
      recorder.add_varying(name + "_ratios_samples", "", curve.samples[k]);
    }
    const Crossing found = crossing(curve.samples, curve.of_brute);
    recorder.add_varying(name + "_cheaper_everywhere", "", found.everywhere ? 1 : 0);
    recorder.add_varying(name + "_cheaper_nowhere", "", found.nowhere ? 1 : 0);
    if (found.from > 0) recorder.add_varying(name + "_cheaper_from", "", found.from);
  }
}

std::vector<Case> cases(const RunOptions& options) {
  const bool paper = options.profile == Profile::kPaper;
  std::vector<Case> cases;
  std::vector<std::string> own{std::string(kMainGround), std::string(kGrowing)};
  if (paper) own.insert(own.end(), {"helens", "maine", std::string(kHelensMosaic)});
  for (const std::string& terrain : grounds(options, std::move(own))) {
    const std::int64_t smallest = terrain == kHelensMosaic ? 4097 : 257,
                       largest = grows(terrain) ? (paper ? 8193 : 513) : (paper ? 1025 : 257);
    cases.push_back({terrain,
                     {kSpecs,
                      {{"path", path_over(terrain)},
                       {"frames", std::int64_t{paper ? 8 : 4}},
                       {"smallest", smallest},
                       {"largest", std::max(smallest, largest)}}},
                     terrain});
  }
  return cases;
}

void measure(const Case& at, const RunOptions& options, Recorder& recorder, Progress& progress) {
  const bool growing = grows(at.terrain);
  const std::vector<int> sides = growing ? doubled_sides(at.integer("smallest"), at.integer("largest"))
                                         : std::vector{at.integer("largest")};
  if (sides.empty())
    throw usage_error("the largest ground is smaller than the smallest", "largest", "exchange the two");
  constexpr double kAvailable = 0.85;  // share of the memory left that is used
  const auto bytes = static_cast<std::uint64_t>(kAvailable * static_cast<double>(available_memory()));
  SizePlan plan("frame", {at.parameters.number("seconds"), bytes}, {1, 1});
  Curves curves;
  std::unique_ptr<GlContext> context;
  for (const int side : sides) {
    const double samples = static_cast<double>(side) * side;
    if (!plan.admits(samples)) continue;
    const std::int64_t held = HeapCounter::live();
    HeapCounter::reset_peak();
    const Stopwatch watch;
    Flight flight({at.terrain, at.parameters.text("path"), side, at.integer("frames"), options.seed},
                  progress);
    if (side == sides.front()) {
      recorder.terrain(flight.source);
      context = open_context(options.renderer, flight.views[0].width, flight.views[0].height);
    }
    measure_ground(flight, at, growing ? fmt::format("_{}", side) : "", *context, recorder, progress, curves);
    plan.measured(samples, watch.seconds(), HeapCounter::peak() - held);
  }
  if (!growing) return;
  recorder.add_varying("frame_sizes", "", static_cast<double>(plan.sizes()));
  plan.record(recorder);
  if (at.terrain == kGrowing) record_growth(curves, recorder);
}

}  // namespace

extern const Experiment kLodFrames{
    "cross.lod-frames", "Whole frames at the same screen-space error", kSpecs, cases, measure,
    Experiment::kTimed};

}  // namespace terrabench::cross
