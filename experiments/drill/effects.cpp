// The 54 outcomes on one ground: best parameter sets, main effects, figures.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "experiments/drill/figures.h"
#include "experiments/drill/ground.h"
#include "experiments/experiment.h"
#include "experiments/figures/maps.h"

namespace terrabench::drill {
namespace {

struct Measure {
  std::string name;
  ErrorOf of;
};

const Measure kMeasures[] = {
    {"rmse", [](const Outcome& o) { return o.rmse; }},
    {"ahd_plane", [](const Outcome& o) { return o.ahd[0]; }},
    {"ahd_space", [](const Outcome& o) { return o.ahd[1]; }},
    {"ahd_sample", [](const Outcome& o) { return o.ahd[2]; }},
};
static_assert(kReadings[0] == ChannelReading::kPlane && kReadings[1] == ChannelReading::kSpace &&
              kReadings[2] == ChannelReading::kSample);

const Outcome& least(const std::vector<Outcome>& outcomes, const Measure& measure) {
  return *std::min_element(outcomes.begin(), outcomes.end(),
                           [&](const Outcome& a, const Outcome& b) { return measure.of(a) < measure.of(b); });
}

void record_measure(const std::vector<Outcome>& outcomes, const Measure& measure, Recorder& recorder) {
  const auto add = [&](std::string_view what, double value) {
    recorder.add(fmt::format("{}_{}", measure.name, what), "", value);
  };
  const Outcome& best = least(outcomes, measure);
  add("least", measure.of(best));
  add("best_tau", best.setting.tau);
  add("best_w", best.setting.w);
  add("best_k", best.setting.k);
  const auto add_effects = [&](const Effects& effects, std::string_view where) {
    add(fmt::format("effect_tau{}", where), effects.tau);
    add(fmt::format("effect_w{}", where), effects.w);
    add(fmt::format("effect_k{}", where), effects.k);
    add(fmt::format("effect_interactions{}", where), effects.interactions);
  };
  const Effects effects = main_effects(outcomes, measure.of);
  add_effects(effects, "");
  // The paper calls parameters good that create no outliers. With the least k much of the ground stays
  // plateau, which dominates the variance.
  std::vector<Outcome> good;
  std::copy_if(outcomes.begin(), outcomes.end(), std::back_inserter(good),
               [](const Outcome& o) { return o.setting.k > kInfluences.front(); });
  add_effects(main_effects(good, measure.of), "_without_outliers");
  for (std::size_t t = 0; t < kTaus.size(); ++t) {
    add(fmt::format("mean_at_tau_{}", kTaus[t]), effects.mean_at_tau[t]);
  }
}

constexpr double kCellWidth = 70, kCellHeight = 36, kLeft = 62, kTop = 64, kBelow = 62, kGap = 20;
constexpr double kMatrixWidth = kCellWidth * kInfluences.size(), kMatrixHeight = kCellHeight * kTaus.size();

// How errors are printed: multiplied by `times`, with `digits` after the point.
struct Figures {
  double times;
  int digits;
  std::string of(double error) const { return fmt::format("{:.{}f}", times * error, digits); }
};

// A logarithmic scale, since the few large errors, of windows that leave plateau uncovered, would hide the
// rest.
struct Scale {
  double low, high;
  double at(double error) const { return high > low ? std::log(error / low) / std::log(high / low) : 0; }
};

void add_matrix(figures::Sheet& sheet, double x0, double y0, int w, const std::vector<Outcome>& outcomes,
                ErrorOf error, const Scale& scale, const Figures& figures) {
  sheet.text(x0, y0 - 8, fmt::format("w = {}", w), 14);
  for (const Outcome& o : outcomes) {
    if (o.setting.w != w) continue;
    const auto column = std::find(kInfluences.begin(), kInfluences.end(), o.setting.k) - kInfluences.begin();
    const auto row = std::find(kTaus.begin(), kTaus.end(), o.setting.tau) - kTaus.begin();
    const double x = x0 + static_cast<double>(column) * kCellWidth,
                 y = y0 + static_cast<double>(row) * kCellHeight;
    const Rgb colour = figures::error_colour(scale.at(error(o)));
    sheet.box(x, y, kCellWidth - 1, kCellHeight - 1, colour);
    sheet.text(x + kCellWidth / 2, y + kCellHeight / 2 + 5, figures.of(error(o)), 13, "middle",
               figures::ink_on(colour));
  }
  for (std::size_t t = 0; t < kTaus.size(); ++t) {
    sheet.text(x0 - 6, y0 + (static_cast<double>(t) + 0.62) * kCellHeight, fmt::format("τ = {}", kTaus[t]),
               12, "end");
  }
  for (std::size_t k = 0; k < kInfluences.size(); ++k) {
    sheet.text(x0 + (static_cast<double>(k) + 0.5) * kCellWidth, y0 + kMatrixHeight + 16,
               fmt::format("k = {}", kInfluences[k]), 12, "middle");
  }
}

void add_column(figures::Sheet& sheet, int column, std::string_view title,
                const std::vector<Outcome>& outcomes, ErrorOf error, const Figures& figures) {
  const double x = kLeft + column * (kLeft + kMatrixWidth + kGap);
  const auto [least, most] =
      std::minmax_element(outcomes.begin(), outcomes.end(),
                          [&](const Outcome& a, const Outcome& b) { return error(a) < error(b); });
  const Scale scale{std::max(error(*least), 1e-12), std::max(error(*most), 1e-12)};
  sheet.text(x + kMatrixWidth / 2, 22, title, 15, "middle");
  double y = kTop;
  for (const int w : kWidths) {
    add_matrix(sheet, x, y, w, outcomes, error, scale, figures);
    y += kMatrixHeight + kBelow;
  }
  const figures::Sheet::Tick ticks[] = {{0, figures.of(scale.low)},
                                        {0.5, figures.of(std::sqrt(scale.low * scale.high))},
                                        {1, figures.of(scale.high)}};
  sheet.colour_bar(x, y - 24, kMatrixWidth - 1, figures::error_colour, ticks);
}

// Figure 4: the error of the 54 parameter sets.
void draw_matrices(const Study& study, const std::vector<Outcome>& outcomes, Recorder& recorder) {
  figures::Sheet sheet(2 * (kLeft + kMatrixWidth + kGap),
                       kTop + kWidths.size() * (kMatrixHeight + kBelow) + 18);
  add_column(sheet, 0, "RMSE ÷ range of elevations", outcomes, [](const Outcome& o) { return o.rmse; },
             {1, 4});
  add_column(sheet, 1, "1000 × AHD in plan ÷ diagonal", outcomes, [](const Outcome& o) { return o.ahd[0]; },
             {1000, 3});
  sheet.write(
      recorder.figure("drill.F4" + study.suffix, "png",
                      fmt::format("The paper's figure 4: normalised errors of the 54 parameter sets on {}, "
                                  "RMSE left and AHD right, one matrix per width w. Colours are logarithmic, "
                                  "from the least of each metric (blue) to the largest (red).",
                                  study.name)));
}

void measure(const Case& at, const RunOptions& options, Recorder& recorder, Progress& progress) {
  const TerrainSource source = recorder.terrain(open_ground(at.terrain, options.seed));
  const FlowNetwork network = route_flow(*source.heights, &progress);
  const std::vector<Outcome> outcomes = factorial(*source.heights, network, progress);

  recorder.add("runs", "", outcomes.size());
  for (const Measure& measure : kMeasures) record_measure(outcomes, measure, recorder);
  // The paper gives w and k of its best set, but τ only as the densest network; hence the least error over τ.
  double at_paper_best = std::numeric_limits<double>::infinity();
  for (const Outcome& o : outcomes) {
    if (o.setting.w == 10 && o.setting.k == 20) at_paper_best = std::min(at_paper_best, o.rmse);
  }
  recorder.add("rmse_at_w10_k20", "", at_paper_best);
  // Flat ground has no error to divide by.
  if (const double best = least(outcomes, kMeasures[0]).rmse; best > 0) {
    recorder.add("rmse_at_w10_k20_to_least", "", at_paper_best / best);
  }

  const Study study{*source.heights, network, source.name, figures::ground_suffix(at.terrain, kMainGround)};
  draw_channels(study, recorder);
  draw_cross_sections(study, recorder);
  draw_best(study, least(outcomes, kMeasures[0]), least(outcomes, kMeasures[1]), recorder);
  draw_matrices(study, outcomes, recorder);
}

}  // namespace

extern const Experiment kEffects{
    "drill.effects", "§3.1: best sets, main effects, figures 1-4", {}, ground_cases, measure};

}  // namespace terrabench::drill
