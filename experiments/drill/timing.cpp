// Time of extraction and regeneration against the threshold and against the number of drills, and what the
// steps of extraction take (the drill paper's §3.1 and §4.1), for each fit. All are processor times on one
// thread, as the paper's scripts ran: a busy machine does not change their ratios.
#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <map>
#include <span>

#include "experiments/drill/factorial.h"
#include "experiments/drill/ground.h"
#include "experiments/experiment.h"
#include "experiments/figures/measures.h"
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
constexpr std::uint32_t kPaperTau = 25;    // regeneration is timed there
constexpr std::array kTimedWidths{5, 20};  // at that τ; cross-sections have 120 · w samples

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

using Times = std::map<std::string, std::vector<double>, std::less<>>;  // by metric

std::string at_tau(std::uint32_t tau) { return fmt::format("extraction_time_tau_{}", tau); }
std::string at_width(int w) { return fmt::format("extraction_time_w_{}", w); }

// How well the medians of extraction lie on a line against something, 1: exactly.
class Linearity {
 public:
  explicit Linearity(const Times& times) : times_(times) {}

  void add(std::uint32_t tau, double against) {
    points_.add(against, median(times_.find(at_tau(tau))->second));
  }
  double r_squared() const { return points_.exists() ? points_.value() * points_.value() : 0; }

 private:
  const Times& times_;
  figures::Correlation points_;
};

void record(const Times& times, Recorder& recorder) {
  std::vector<std::string> metrics{"routing_time", "union_time", "fitting_time", "regeneration_time"};
  for (const std::uint32_t tau : {10, 25, 100, 200, 800}) metrics.push_back(at_tau(tau));
  for (const int w : kTimedWidths) metrics.push_back(at_width(w));
  for (const std::string& metric : metrics) {
    for (const double time : times.find(metric)->second) recorder.add(metric, "s", time);
  }
}

void record_lines(const Times& times, const std::vector<Drills>& drills, Recorder& recorder) {
  Linearity pixels(times), taus(times), levels(times);  // the factorial's levels alone
  for (std::size_t t = 0; t < kTimedTaus.size(); ++t) {
    const std::uint32_t tau = kTimedTaus[t];
    pixels.add(tau, static_cast<double>(drills[t].count()));
    taus.add(tau, tau);
    if (std::ranges::count(kTaus, tau) > 0) levels.add(tau, tau);
  }
  recorder.add_varying("r_squared", "", pixels.r_squared());
  recorder.add_varying("r_squared_tau", "", taus.r_squared());
  recorder.add_varying("r_squared_tau_levels", "", levels.r_squared());
}

void record_ratios(const Times& times, Recorder& recorder) {
  const auto typical = [&](std::string_view metric) { return median(times.find(metric)->second); };
  const auto add_varying_share = [&](std::string_view metric, double value) {
    if (std::isfinite(value)) recorder.add_varying(metric, "", value);
  };
  const double routing = typical("routing_time"), shapes = typical(at_tau(kPaperTau)),
               regeneration = typical("regeneration_time");
  add_varying_share("shapes_to_regeneration", shapes / regeneration);
  add_varying_share("all_to_regeneration", (routing + shapes) / regeneration);
  const double unions = typical("union_time"), fitting = typical("fitting_time"),
               all = routing + unions + fitting;
  add_varying_share("fitting_share", fitting / all);
  add_varying_share("union_and_fitting_share", (unions + fitting) / all);
}

void measure(const Case& test_case, const RunOptions& options, Recorder& recorder, Progress& progress) {
  const TerrainSource source = recorder.terrain(open_ground(test_case.terrain, options.seed));
  const Heightfield& ground = *source.heights;
  const Variant& variant = variant_of(test_case.parameters);
  FlowNetwork network;
  std::vector<Drills> drills(kTimedTaus.size());
  Times times;
  bool agree = true;
  progress.begin("timing extraction", kSamples);
  // Thresholds alternate, so that a slow period of the machine affects all alike. The first round warms up.
  for (int sample = -1; sample < kSamples; ++sample) {
    const auto time = [&](const std::string& metric, const auto& work) {
      const double spent = processor_seconds(work);
      if (sample >= 0) times[metric].push_back(spent);
    };
    time("routing_time", [&] { network = variant.route(ground); });
    for (std::size_t t = 0; t < kTimedTaus.size(); ++t) {
      const DrillOptions extract = options_for({.tau = kTimedTaus[t], .k = 20}, variant);
      time(at_tau(kTimedTaus[t]), [&] { drills[t] = extract_drills(ground, network, extract); });
    }
    for (const int w : kTimedWidths) {
      time(at_width(w), [&] { extract_drills(ground, network, options_for({.w = w}, variant)); });
    }
    const Drills& paper = drills[std::ranges::find(kTimedTaus, kPaperTau) - kTimedTaus.begin()];
    ShapeSteps steps(ground, paper, variant);
    time("union_time", [&] { steps.collect_unions(); });
    time("fitting_time", [&] { steps.fit(); });
    agree = agree && steps.agree();
    time("regeneration_time", [&] { regenerate(paper); });
    if (sample >= 0) progress.advance();
  }
  record(times, recorder);
  record_lines(times, drills, recorder);
  record_ratios(times, recorder);
  recorder.add("steps_agree", "", agree ? 1 : 0);
}

}  // namespace

extern const Experiment kTime{"drill.time",    "§3.1: time against thresholds and channel pixels",
                              variant_specs(), fit_cases,
                              measure,         Experiment::kTimed};

}  // namespace terrabench::drill
