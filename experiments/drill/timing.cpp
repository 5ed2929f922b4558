// Time of extraction and regeneration against the threshold and against the number of drills, and what the
// steps of extraction take (the drill paper's §3.1 and §4.1), for each fit. All are processor times on one
// thread, as the paper's scripts ran: a busy machine does not change their ratios.
#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <span>

#include "experiments/drill/factorial.h"
#include "experiments/drill/ground.h"
#include "experiments/experiment.h"
#include "experiments/samples.h"
#include "experiments/stopwatch.h"
#include "representations/drill/cross_sections.h"
#include "representations/drill/extract.h"
#include "representations/drill/profile_fit.h"
#include "representations/drill/regenerate.h"
#include "results/store/statistics.h"
#include "terrain/hydrology/flow.h"

namespace terrabench::drill {
namespace {

constexpr std::array<std::uint32_t, 8> kTimedTaus{10, 15, 25, 50, 100, 200, 400, 800};
constexpr std::size_t kPaperTau = 2;       // 25: regeneration is timed there
constexpr std::array kTimedWidths{5, 20};  // at that τ; cross-sections have 120 · w samples

// Least squares of y = intercept + slope · x.
struct Line {
  double slope = 0, intercept = 0, r_squared = 0;
};

Line fit_line(const std::vector<double>& x, const std::vector<double>& y) {
  const auto n = static_cast<double>(x.size());
  double mx = 0, my = 0, xx = 0, xy = 0, yy = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    mx += x[i] / n;
    my += y[i] / n;
  }
  for (std::size_t i = 0; i < x.size(); ++i) {
    xx += (x[i] - mx) * (x[i] - mx);
    xy += (x[i] - mx) * (y[i] - my);
    yy += (y[i] - my) * (y[i] - my);
  }
  if (xx == 0 || yy == 0) return {};
  return {xy / xx, my - xy / xx * mx, xy * xy / (xx * yy)};
}

double median(const std::vector<double>& samples) { return summarise(samples).median; }

// The steps of extraction after routing, one after the other for all drills, as extract_drills() takes them
// together: the unions of the cross-sections, then the quadratic functions.
class ShapeSteps {
 public:
  ShapeSteps(const Heightfield& ground, const Drills& drills, const Variant& variant)
      : ground_(ground), drills_(drills), fit_(variant.fit) {}

  void collect_unions() {
    const CrossSections sections(ground_, drills_.w);
    unions_.resize(drills_.count() * width());
    tbb::parallel_for(std::size_t{0}, drills_.count(),
                      [&](std::size_t drill) { sections.join(drills_.pixel[drill], at(drill)); });
  }
  void fit() {
    shapes_.resize(drills_.count());
    tbb::parallel_for(std::size_t{0}, drills_.count(), [&](std::size_t drill) {
      shapes_[drill] = fit_profile(at(drill), drills_.elevation[drill], fit_);
    });
  }
  // Whether they gave the same shapes as extract_drills().
  bool agree() const {
    for (std::size_t i = 0; i < drills_.count(); ++i) {
      if (!shapes_[i].determined) continue;
      if (shapes_[i].slope != drills_.slope[i] || shapes_[i].curvature != drills_.curvature[i]) return false;
    }
    return true;
  }

 private:
  std::size_t width() const { return static_cast<std::size_t>(drills_.w); }
  std::span<float> at(std::size_t drill) { return {unions_.data() + drill * width(), width()}; }

  const Heightfield& ground_;
  const Drills& drills_;
  DrillFit fit_;
  std::vector<float> unions_;  // w heights per drill
  std::vector<FittedProfile> shapes_;
};

// All that is timed on one ground.
struct Times {
  std::vector<double> routing, unions, fitting;  // the last two at the paper's τ
  std::vector<double> regeneration;              // k = 20
  std::vector<std::vector<double>> extraction;   // by threshold, without routing
  std::array<std::vector<double>, kTimedWidths.size()> extraction_by_width;

  void record(Recorder& recorder) const {
    const auto add = [&](std::string_view metric, const std::vector<double>& samples) {
      for (const double time : samples) recorder.add(metric, "s", time);
    };
    add("routing_time", routing);
    add("union_time", unions);
    add("fitting_time", fitting);
    add("regeneration_time", regeneration);
    for (std::size_t t = 0; t < kTimedTaus.size(); ++t) {
      add(fmt::format("extraction_time_tau_{}", kTimedTaus[t]), extraction[t]);
    }
    for (std::size_t w = 0; w < kTimedWidths.size(); ++w) {
      add(fmt::format("extraction_time_w_{}", kTimedWidths[w]), extraction_by_width[w]);
    }
  }
};

void record_lines(const Times& times, const std::vector<Drills>& drills, Recorder& recorder) {
  std::vector<double> pixels, taus, medians;
  for (std::size_t t = 0; t < kTimedTaus.size(); ++t) {
    pixels.push_back(static_cast<double>(drills[t].count()));
    taus.push_back(kTimedTaus[t]);
    medians.push_back(median(times.extraction[t]));
    recorder.add(fmt::format("drills_tau_{}", kTimedTaus[t]), "", pixels.back());
  }
  const Line line = fit_line(pixels, medians);
  recorder.add("seconds_per_drill", "s", line.slope);
  recorder.add("seconds_without_drills", "s", line.intercept);
  recorder.add_varying("r_squared", "", line.r_squared);
  recorder.add_varying("r_squared_tau", "", fit_line(taus, medians).r_squared);
  // At the factorial's levels alone.
  std::vector<double> levels, at_levels;
  for (std::size_t t = 0; t < kTimedTaus.size(); ++t) {
    if (std::ranges::count(kTaus, kTimedTaus[t]) == 0) continue;
    levels.push_back(taus[t]);
    at_levels.push_back(medians[t]);
  }
  recorder.add_varying("r_squared_tau_levels", "", fit_line(levels, at_levels).r_squared);
}

void record_ratios(const Times& times, Recorder& recorder) {
  const auto add_varying_share = [&](std::string_view metric, double value) {
    if (std::isfinite(value)) recorder.add_varying(metric, "", value);
  };
  const double routing = median(times.routing), shapes = median(times.extraction[kPaperTau]);
  const double regeneration = median(times.regeneration);
  add_varying_share("shapes_to_regeneration", shapes / regeneration);
  add_varying_share("all_to_regeneration", (routing + shapes) / regeneration);
  const double unions = median(times.unions), fitting = median(times.fitting),
               all = routing + unions + fitting;
  add_varying_share("fitting_share", fitting / all);
  add_varying_share("union_and_fitting_share", (unions + fitting) / all);
}

void measure(const Case& at, const RunOptions& options, Recorder& recorder, Progress& progress) {
  const TerrainSource source = recorder.terrain(open_ground(at.terrain, options.seed));
  const Heightfield& ground = *source.heights;
  const Variant& variant = variant_of(at.parameters);
  FlowNetwork network = variant.route(ground);
  std::vector<Drills> drills(kTimedTaus.size());
  Times times;
  times.extraction.resize(kTimedTaus.size());
  bool agree = true;
  progress.begin("timing extraction", kSamples);
  // Thresholds alternate, so that a slow period of the machine affects all alike. The first round warms up.
  for (int sample = -1; sample < kSamples; ++sample) {
    const auto time = [&](std::vector<double>& of, const auto& work) {
      const double spent = processor_seconds(work);
      if (sample >= 0) of.push_back(spent);
    };
    time(times.routing, [&] { network = variant.route(ground); });
    for (std::size_t t = 0; t < kTimedTaus.size(); ++t) {
      const DrillOptions extract = options_for({.tau = kTimedTaus[t], .k = 20}, variant);
      time(times.extraction[t], [&] { drills[t] = extract_drills(ground, network, extract); });
    }
    for (std::size_t w = 0; w < kTimedWidths.size(); ++w) {
      const DrillOptions extract = options_for({.w = kTimedWidths[w]}, variant);
      time(times.extraction_by_width[w], [&] { extract_drills(ground, network, extract); });
    }
    Drills& paper = drills[kPaperTau];
    ShapeSteps steps(ground, paper, variant);
    time(times.unions, [&] { steps.collect_unions(); });
    time(times.fitting, [&] { steps.fit(); });
    agree = agree && steps.agree();
    time(times.regeneration, [&] { regenerate(paper); });
    if (sample >= 0) progress.advance();
  }
  times.record(recorder);
  record_lines(times, drills, recorder);
  record_ratios(times, recorder);
  recorder.add("steps_agree", "", agree ? 1 : 0);
}

}  // namespace

extern const Experiment kTime{"drill.time", "§3.1: time against thresholds and channel pixels",
                              fit_specs(),  fit_cases,
                              measure,      Experiment::kTimed};

}  // namespace terrabench::drill
