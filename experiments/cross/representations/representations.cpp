// Every type of representation on the same grounds, at the same resolution, at the same bytes and at the same
// error: what each costs, how closely it keeps the ground, and how fast it answers.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "experiments/cross/representations/representation_costs.h"
#include "experiments/cross/representations/scenes.h"
#include "experiments/cross/representations/setting_search.h"
#include "experiments/experiment.h"

namespace terrabench::cross {
namespace {

const std::array kSpecs{
    ParameterSpec{"representation", std::string("heightmap"), "",
                  "a name of `terrabench list representations`"},
    ParameterSpec{"share", 0.0, "",
                  "of the heightmap's bytes in memory, for the file; 0: the same resolution instead", 0, 1},
    ParameterSpec{"error", 0.0, "",
                  "of the ground's relief: the RMSE of the tops for which the type is tuned; 0: not tuned", 0,
                  1},
    ParameterSpec{"size", std::int64_t{257}, "samples", "side of the fractal ground, 2^n + 1", 3, 8193},
    ParameterSpec{"resolution", std::int64_t{64}, "columns", "along solid ground", 2, 4096},
    ParameterSpec{"lines", std::int64_t{101}, "", "along the ground, on which volumes are compared", 2, 4001},
    ParameterSpec{"rays", std::int64_t{8192}, "", "of each kind", 1, 1 << 24},
};

constexpr double kLeastShare = 0.01, kQuickError = 0.02;
constexpr std::array kShares{kLeastShare, 0.05, 0.2};
// Of the relief. A cliff or the lip of an overhang lies somewhere between two columns, so that few types come
// within 0.5 % of a solid's top.
constexpr std::array kErrorsOfHeights{0.001, 0.005, kQuickError}, kErrorsOfSolids{0.01, kQuickError, 0.05};
// Cells between the core of a cavity and what is solid. The centre of the cell around a point is less than
// 0.87 cells away, so that cells sampled at their centres keep a core as air.
constexpr float kMargin = 1;

std::vector<Case> cases(const RunOptions& options) {
  const bool paper = options.profile == Profile::kPaper;
  std::vector<Case> cases;
  for (const std::string& terrain : compared_scenes(options)) {
    const std::int64_t resolution = solid_resolution(terrain, paper);
    const auto& errors = is_solid(terrain) ? kErrorsOfSolids : kErrorsOfHeights;
    for (const RepresentationType& type : representations()) {
      const auto add = [&](const std::string& suffix, double share, double error) {
        cases.push_back({fmt::format("{}/{}{}", terrain, type.name, suffix),
                         {kSpecs,
                          {{"representation", std::string(type.name)},
                           {"share", share},
                           {"error", error},
                           {"size", std::int64_t{paper ? 1025 : 257}},
                           {"resolution", resolution},
                           {"lines", std::int64_t{paper ? 211 : 101}},
                           {"rays", std::int64_t{paper ? 1 << 17 : 1 << 13}}}},
                         terrain});
      };
      add("", 0, 0);
      for (const double share : kShares) {
        if (paper || share != kLeastShare) add(fmt::format("/{:.0f}%", 100 * share), share, 0);
      }
      for (const double error : errors) {
        if (paper || error == kQuickError) add(fmt::format("/rmse={:g}%", 100 * error), 0, error);
      }
    }
  }
  return cases;
}

void record_tops(const Differences& found, Recorder& recorder) {
  recorder.add("columns", "", found.columns);
  recorder.add("lost_columns", "", found.lost_columns);
  if (found.columns == 0) {
    return recorder.undefined({"rmse", "error_p99", "largest_error"},
                              "the type and the ground share no column");
  }
  recorder.add("rmse", "m", found.rmse);
  recorder.add("error_p99", "m", found.p99);
  recorder.add("largest_error", "m", found.largest);
}

void record(const Differences& found, const TerrainSource& source, Recorder& recorder) {
  record_tops(found, recorder);
  if (found.distance) {
    recorder.add("hausdorff", "m", found.distance->hausdorff());
  } else {
    recorder.undefined({"hausdorff"},
                       "the type or the ground has no surface on the lines on which they are compared");
  }
  if (found.volume_iou) {
    recorder.add("volume_iou", "", *found.volume_iou);
    recorder.add("volume_error", "", 1 - *found.volume_iou);
  } else {
    recorder.undefined({"volume_iou", "volume_error"},
                       "neither the type nor the ground has volume on the lines on which they are compared");
  }
  if (source.heights) return;
  recorder.add("cavities", "m³", found.cavities);
  recorder.add("cores", "m³", found.cores);
  recorder.add_ratio("cavities_lost", found.cavities_filled, found.cavities, "the ground has no cavities");
  recorder.add_ratio("cores_lost", found.cores_filled, found.cores, "no cavity is deep enough for a core");
}

// Every setting that was tried, for the plot of error against bytes.
void record_trials(const SettingSearch& search, Recorder& recorder) {
  for (const Trial& trial : search.trials()) {
    recorder.add("tried_bytes", "B", static_cast<double>(trial.file_bytes));
    recorder.add("tried_rmse", "m", trial.rmse);
    recorder.add("tried_volume_error", "", trial.volume_error);
  }
}

void measure_at_bytes(const Scene& scene, const RepresentationType& type, double share, Recorder& recorder,
                      Progress& progress) {
  const double budget = share * static_cast<double>(scene.heightmap_bytes);
  SettingSearch search(scene, type, progress);
  const std::optional<FoundSetting> chosen = search.for_bytes(budget);
  recorder.add("fits", "", chosen ? 1 : 0);
  const double used = chosen ? static_cast<double>(chosen->trial.file_bytes) / budget : 0;
  recorder.add("same_bytes", "", used >= kLeastOfBytes ? 1 : 0);
  record_trials(search, recorder);
  if (!chosen) {
    if (const auto trials = search.trials(); !trials.empty()) {
      const Trial& smallest = *std::ranges::min_element(trials, {}, &Trial::file_bytes);
      recorder.add("smallest_of_budget", "", static_cast<double>(smallest.file_bytes) / budget);
    }
    return;
  }
  const auto built = type.build(scene.source, chosen->parameters, progress);
  recorder.add("setting", "", static_cast<double>(chosen->trial.setting));
  recorder.add("file_bytes", "B", chosen->trial.file_bytes);
  recorder.add("of_budget", "", used);
  recorder.add("bytes", "B", built->memory().total());
  record(differences(*built, scene.source, scene.lines, kMargin * scene.cell), scene.source, recorder);
}

void measure_at_error(const Scene& scene, const RepresentationType& type, double share, Recorder& recorder,
                      Progress& progress) {
  const double relief = relief_of(scene), asked = share * relief;
  if (relief == 0) {
    return recorder.undefined({"same_error", "least_of_relief", "of_asked"},
                              "the ground is flat: an error has no share of its relief");
  }
  SettingSearch search(scene, type, progress);
  const std::optional<FoundSetting> chosen = search.for_error(asked);
  const double used = chosen ? chosen->trial.rmse / asked : 0;
  recorder.add("same_error", "", used >= kLeastOfError ? 1 : 0);
  record_trials(search, recorder);
  if (const auto trials = search.trials(); !trials.empty()) {
    const Trial& best = *std::ranges::min_element(trials, {}, &Trial::rmse);
    recorder.add("least_of_relief", "", best.rmse / relief);
  }
  if (!chosen) return;
  if (chosen->trial.setting > 0) recorder.add("setting", "", static_cast<double>(chosen->trial.setting));
  recorder.add("of_asked", "", used);
  Samples samples;
  const auto built = measure_build(scene, type, chosen->parameters, recorder, samples, progress);
  measure_file(scene, type, *built, recorder, samples);
  measure_queries(scene, *built, samples);
  samples.take(recorder);
  record(differences(*built, scene.source, scene.lines, kMargin * scene.cell), scene.source, recorder);
}

// Times are measured at the same resolution and at the same error, not at the same bytes.
bool times(const Case& at) { return at.parameters.number("share") == 0; }

void measure(const Case& at, const RunOptions& options, Recorder& recorder, Progress& progress) {
  const Scene& ground =
      scene({at.terrain, at.integer("size"), at.integer("resolution"), at.integer("lines"), options.seed},
            progress);
  recorder.terrain(ground.source);
  const RepresentationType& type = representation(at.parameters.text("representation"));
  if (const double share = at.parameters.number("share"); share > 0) {
    measure_at_bytes(ground, type, share, recorder, progress);
    return;
  }
  if (const double share = at.parameters.number("error"); share > 0) {
    measure_at_error(ground, type, share, recorder, progress);
    return;
  }
  Samples samples;
  const auto built = measure_build(ground, type, ground.parameters(type), recorder, samples, progress);
  measure_file(ground, type, *built, recorder, samples);
  measure_queries(ground, *built, samples);
  record(differences(*built, ground.source, ground.lines, kMargin * ground.cell), ground.source, recorder);
  const TriangleMesh mesh = measure_mesh(*built, recorder, samples);
  measure_rays(ground, *built, mesh, at.integer("rays"), recorder, samples);
  samples.take(recorder);
  measure_edit(ground, type, *built, mesh, recorder, progress);
}

}  // namespace

extern const Experiment kRepresentations{
    .id = "cross.representations",
    .title = "Representations on the same ground, at the same bytes, at the same error",
    .parameters = kSpecs,
    .cases = cases,
    .measure = measure,
    .kind = Experiment::kTimed,
    .times = times};

}  // namespace terrabench::cross
