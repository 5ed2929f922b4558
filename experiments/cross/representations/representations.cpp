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
    ParameterSpec{
        "error", 0.0, "",
        "for which the type is tuned: RMSE of the tops as a share of the ground's relief; of a solid "
        "the share of the volume that differs; 0: not tuned",
        0, 1},
    ParameterSpec{"size", std::int64_t{257}, "samples", "side of the fractal ground, 2^n + 1", 3, 8193},
    ParameterSpec{"resolution", std::int64_t{64}, "columns", "along solid ground", 2, 4096},
    ParameterSpec{"lines", std::int64_t{101}, "", "along the ground, on which volumes are compared", 2, 4001},
    ParameterSpec{"rays", std::int64_t{8192}, "", "of each kind", 1, 1 << 24},
};

// Of the relief; of the volume, and twenty times as much of the air under overhangs (setting_search.h).
// Rays and edits are measured at one: over heights at the largest, since drills reach no smaller one, over
// solids at the smallest, at which no type fills a tunnel.
constexpr std::array kErrorsOfHeights{0.001, 0.005, 0.02}, kErrorsOfSolids{0.005, 0.01, 0.02};
double edited_error(bool solid) { return solid ? kErrorsOfSolids[0] : kErrorsOfHeights[2]; }
// Cells between the core of a cavity and what is solid. The centre of the cell around a point is less than
// 0.87 cells away, so that cells sampled at their centres keep a core as air.
constexpr float kMargin = 1;

std::vector<Case> cases(const RunOptions& options) {
  const bool paper = options.profile == Profile::kPaper;
  std::vector<Case> cases;
  for (const std::string& terrain : compared_scenes(options)) {
    const std::int64_t resolution = solid_resolution(terrain, paper);
    const bool solid = is_solid(terrain);
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
      const auto& errors = solid ? kErrorsOfSolids : kErrorsOfHeights;
      for (const double error : errors) {
        if (!paper && error == errors[1]) continue;
        add(fmt::format("/{}={:g}%", solid ? "volume" : "rmse", 100 * error), error);
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
  recorder.add_ratio("cores_lost", found.cores_filled, found.cores, "no cavity is deep enough for a core");
}

// `rays`: of each kind; 0: neither meshes nor rays nor edits.
void measure_costs(const Scene& scene, const RepresentationType& type, const Parameters& parameters, int rays,
                   Recorder& recorder, Progress& progress) {
  Samples samples;
  const auto built = measure_build(scene, type, parameters, recorder, samples, progress);
  measure_file(scene, type, *built, recorder, samples);
  measure_queries(scene, *built, samples);
  Differences found = differences(*built, scene.source, scene.lines, kMargin * scene.cell);
  if (scene.source.solid) {
    const VolumeErrors errors = volume_errors(*built, scene.random);
    found.volume_iou = 1 - errors.volume;
    recorder.add("air_iou", "", 1 - errors.air);
  }
  record(found, scene.source, recorder);
  if (rays == 0) return samples.take(recorder);
  const TriangleMesh mesh = measure_mesh(*built, recorder, samples);
  measure_rays(scene, *built, mesh, rays, recorder, samples);
  samples.take(recorder);
  measure_edit(scene, type, parameters, *built, mesh, recorder, progress);
}

void measure_at_error(const Scene& scene, const RepresentationType& type, double share, int rays,
                      Recorder& recorder, Progress& progress) {
  const double unit = scene.source.solid ? 1 : relief_of(scene), asked = share * unit;
  if (unit == 0) {
    return recorder.undefined({"same_error", "least_of_relief", "of_asked"},
                              "the ground is flat: an error has no share of its relief");
  }
  SettingSearch search(scene, type, progress);
  const std::optional<FoundSetting> chosen = search.for_error(asked);
  recorder.add("same_error", "", chosen ? 1 : 0);
  if (const auto trials = search.trials(); !trials.empty()) {
    const Trial& best = *std::ranges::min_element(trials, {}, &Trial::error);
    recorder.add(scene.source.solid ? "least_error" : "least_of_relief", "", best.error / unit);
  }
  if (!chosen) return;
  if (chosen->trial.setting > 0) recorder.add("setting", "", chosen->trial.setting);
  recorder.add("of_asked", "", chosen->trial.error / asked);
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
  const bool edited = error == edited_error(ground.source.solid.has_value());
  measure_at_error(ground, type, error, edited ? rays : 0, recorder, progress);
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
