// Every type of representation on the same grounds, at the same resolution and at the same error: what each
// costs, how closely it keeps the ground, and how fast it answers.
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
    ParameterSpec{"error", 0.0, "",
                  "of the ground's relief: the RMSE of the tops for which the type is tuned; 0: not tuned", 0,
                  1},
    ParameterSpec{"size", std::int64_t{257}, "samples", "side of the fractal ground, 2^n + 1", 3, 8193},
    ParameterSpec{"resolution", std::int64_t{64}, "columns", "along solid ground", 2, 4096},
    ParameterSpec{"lines", std::int64_t{101}, "", "along the ground, on which volumes are compared", 2, 4001},
    ParameterSpec{"rays", std::int64_t{8192}, "", "of each kind", 1, 1 << 24},
};

constexpr double kRankedError = 0.02;  // at which types are ranked, and the only one in quick
// Of the relief. A cliff or the lip of an overhang lies somewhere between two columns, so that few types come
// within 0.5 % of a solid's top.
constexpr std::array kErrorsOfHeights{0.001, 0.005, kRankedError}, kErrorsOfSolids{0.01, kRankedError, 0.05};
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
      const auto add = [&](const std::string& suffix, double error) {
        cases.push_back({fmt::format("{}/{}{}", terrain, type.name, suffix),
                         {kSpecs,
                          {{"representation", std::string(type.name)},
                           {"error", error},
                           {"size", std::int64_t{paper ? 1025 : 257}},
                           {"resolution", resolution},
                           {"lines", std::int64_t{paper ? 211 : 101}},
                           {"rays", std::int64_t{paper ? 1 << 17 : 1 << 13}}}},
                         terrain});
      };
      add("", 0);
      for (const double error : errors) {
        if (paper || error == kRankedError) add(fmt::format("/rmse={:g}%", 100 * error), error);
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
  } else {
    recorder.undefined({"volume_iou"},
                       "neither the type nor the ground has volume on the lines on which they are compared");
  }
  if (source.heights) return;
  recorder.add("cavities", "m³", found.cavities);
  recorder.add("cores", "m³", found.cores);
  recorder.add_ratio("cavities_lost", found.cavities_filled, found.cavities, "the ground has no cavities");
  if (found.cavities > 0) recorder.add("cavities_kept", "", 1 - found.cavities_filled / found.cavities);
  recorder.add_ratio("cores_lost", found.cores_filled, found.cores, "no cavity is deep enough for a core");
}

// `rays`: of each kind; 0: neither meshes nor rays nor edits.
void measure_costs(const Scene& scene, const RepresentationType& type, const Parameters& parameters, int rays,
                   Recorder& recorder, Progress& progress) {
  Samples samples;
  const auto built = measure_build(scene, type, parameters, recorder, samples, progress);
  measure_file(scene, type, *built, recorder, samples);
  measure_queries(scene, *built, samples);
  record(differences(*built, scene.source, scene.lines, kMargin * scene.cell), scene.source, recorder);
  if (rays == 0) return samples.take(recorder);
  const TriangleMesh mesh = measure_mesh(*built, recorder, samples);
  measure_rays(scene, *built, mesh, rays, recorder, samples);
  samples.take(recorder);
  measure_edit(scene, type, parameters, *built, mesh, recorder, progress);
}

void measure_at_error(const Scene& scene, const RepresentationType& type, double share, int rays,
                      Recorder& recorder, Progress& progress) {
  const double relief = relief_of(scene), asked = share * relief;
  if (relief == 0) {
    return recorder.undefined({"same_error", "least_of_relief", "of_asked"},
                              "the ground is flat: an error has no share of its relief");
  }
  SettingSearch search(scene, type, progress);
  const std::optional<FoundSetting> chosen = search.for_error(asked);
  const double used = chosen ? chosen->trial.rmse / asked : 0;
  recorder.add("same_error", "", used >= kLeastOfError ? 1 : 0);
  if (const auto trials = search.trials(); !trials.empty()) {
    const Trial& best = *std::ranges::min_element(trials, {}, &Trial::rmse);
    recorder.add("least_of_relief", "", best.rmse / relief);
  }
  if (!chosen) return;
  if (chosen->trial.setting > 0) recorder.add("setting", "", chosen->trial.setting);
  recorder.add("of_asked", "", used);
  measure_costs(scene, type, chosen->parameters, rays, recorder, progress);
}

void measure(const Case& at, const RunOptions& options, Recorder& recorder, Progress& progress) {
  const Scene& ground =
      scene({at.terrain, at.integer("size"), at.integer("resolution"), at.integer("lines"), options.seed},
            progress);
  recorder.terrain(ground.source);
  const RepresentationType& type = representation(at.parameters.text("representation"));
  const double error = at.parameters.number("error");
  const int rays = at.integer("rays");
  if (error == 0) return measure_costs(ground, type, ground.parameters(type), rays, recorder, progress);
  measure_at_error(ground, type, error, error == kRankedError ? rays : 0, recorder, progress);
}

}  // namespace

extern const Experiment kRepresentations{
    .id = "cross.representations",
    .title = "Representations on the same ground, at the same resolution, at the same error",
    .parameters = kSpecs,
    .cases = cases,
    .measure = measure,
    .kind = Experiment::kTimed};

}  // namespace terrabench::cross
