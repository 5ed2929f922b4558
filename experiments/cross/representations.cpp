// Every type of representation on the same grounds, at the same resolution and at the same bytes: what each
// costs, how closely it keeps the ground, and how fast it answers.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "experiments/cross/representation_costs.h"
#include "experiments/cross/scenes.h"
#include "experiments/experiment.h"
#include "experiments/ground.h"
#include "experiments/stopwatch.h"
#include "terrain/error.h"

namespace terrabench::cross {
namespace {

const std::array kSpecs{
    ParameterSpec{"representation", std::string("heightmap"), "",
                  "a name of `terrabench list representations`"},
    ParameterSpec{"share", 0.0, "",
                  "of the heightmap's bytes in memory, for the file; 0: the same resolution instead", 0, 1},
    ParameterSpec{"size", std::int64_t{257}, "samples", "side of the fractal ground, 2^n + 1", 3, 8193},
    ParameterSpec{"resolution", std::int64_t{64}, "columns", "along solid ground", 2, 4096},
    ParameterSpec{"lines", std::int64_t{101}, "", "along the ground, on which volumes are compared", 2, 4001},
    ParameterSpec{"rays", std::int64_t{8192}, "", "of each kind", 1, 1 << 24},
};

constexpr std::array kShares{0.01, 0.05, 0.2};
// Cells between the core of a cavity and what is solid. The centre of the cell around a point is less than
// 0.87 cells away, so that cells sampled at their centres keep a core as air.
constexpr float kMargin = 1;

std::vector<Case> cases(const RunOptions& options) {
  const bool paper = options.profile == Profile::kPaper;
  std::vector<Case> cases;
  for (const std::string& terrain :
       grounds(options, {"jacksboro", "fractal", "caves", "canyon", "sequence"})) {
    // One column more for the canyon: at 256 its tunnel does not fit the tree, which refuses the event.
    const std::int64_t resolution = !paper                ? (terrain == "caves" ? 64 : 128)
                                    : terrain == "canyon" ? 257
                                                          : 256;
    for (const RepresentationType& type : representations()) {
      const auto add = [&](const std::string& suffix, double share) {
        cases.push_back({fmt::format("{}/{}{}", terrain, type.name, suffix),
                         {kSpecs,
                          {{"representation", std::string(type.name)},
                           {"share", share},
                           {"size", std::int64_t{paper ? 1025 : 257}},
                           {"resolution", resolution},
                           {"lines", std::int64_t{paper ? 211 : 101}},
                           {"rays", std::int64_t{paper ? 1 << 17 : 1 << 13}}}},
                         terrain});
      };
      add("", 0);
      for (const double share : kShares) add(fmt::format("/{:.0f}%", 100 * share), share);
    }
  }
  return cases;
}

void record(const Differences& found, const TerrainSource& source, Recorder& recorder) {
  recorder.add("rmse", "m", found.rmse);
  recorder.add("error_p99", "m", found.p99);
  recorder.add("largest_error", "m", found.largest);
  recorder.add("columns", "", found.columns);
  recorder.add("lost_columns", "", found.lost_columns);
  recorder.add("hausdorff", "m", found.hausdorff);
  recorder.add("hausdorff_from_ground", "m", found.from_ground);
  recorder.add("hausdorff_to_ground", "m", found.to_ground);
  recorder.add("volume_iou", "", found.volume_iou);
  recorder.add("volume_error", "", 1 - found.volume_iou);
  if (source.heights) return;
  recorder.add("cavities", "m³", found.cavities);
  recorder.add("cores", "m³", found.cores);
  if (found.cavities > 0) recorder.add("cavities_lost", "", found.cavities_filled / found.cavities);
  if (found.cores > 0) recorder.add("cores_lost", "", found.cores_filled / found.cores);
}

struct Fitted {
  std::unique_ptr<Representation> built;
  std::int64_t setting = 0;
  std::size_t bytes = 0;  // of the file
};

// Null where the type refuses the setting.
Fitted try_setting(const Scene& scene, const RepresentationType& type, std::string_view parameter,
                   std::int64_t setting, Progress& progress) {
  Parameters parameters = scene.parameters(type);
  parameters.set(parameter, setting);
  try {
    Fitted made{type.build(scene.source, parameters, progress), setting, 0};
    made.bytes = file_bytes(type, *made.built);
    return made;
  } catch (const Error& error) {
    if (error.code() != ExitCode::kBadInput && error.code() != ExitCode::kUsage) throw;
    return {};
  }
}

// For types that choose their settings for a budget. The budget excludes the file's own head, which the first
// attempt tells.
Fitted fit_by_budget(const Scene& scene, const RepresentationType& type, double budget, Progress& progress) {
  Fitted made = try_setting(scene, type, "budget_bytes", std::llround(budget), progress);
  if (!made.built || static_cast<double>(made.bytes) <= budget) return made;
  const double excess = static_cast<double>(made.bytes) - budget;
  made = try_setting(scene, type, "budget_bytes", std::max(1LL, std::llround(budget - excess)), progress);
  return static_cast<double>(made.bytes) <= budget ? std::move(made) : Fitted{};
}

// The finest resolution found whose file takes at most `budget` bytes, up to the ground's own. A resolution
// at which the type cannot hold the ground counts as too coarse. Null if there is none.
Fitted fit_by_resolution(const Scene& scene, const RepresentationType& type, double budget,
                         Progress& progress) {
  constexpr int kProbes = 8, kCoarsest = 4;
  constexpr double kClose = 0.95;
  const double finest = scene.source.heights
                            ? std::max(scene.source.heights->width, scene.source.heights->depth)
                            : scene.options.resolution;
  Fitted best;
  double low = kCoarsest, high = finest;
  for (int k = 0; k < kProbes && static_cast<double>(best.bytes) < kClose * budget; ++k) {
    const auto resolution = static_cast<std::int64_t>(k == 0 ? finest : std::sqrt(low * high));
    if (k > 0 && static_cast<double>(resolution) <= low) break;
    Fitted made = try_setting(scene, type, "resolution", resolution, progress);
    const bool fits = static_cast<double>(made.bytes) <= budget;  // also what the type refuses
    (fits ? low : high) = static_cast<double>(resolution);
    if (fits && made.bytes > best.bytes) best = std::move(made);
    if (k == 0 && fits) break;
  }
  return best;
}

Fitted fit(const Scene& scene, const RepresentationType& type, double budget, Progress& progress) {
  const Parameters parameters(type.parameters);
  if (parameters.has("budget_bytes")) return fit_by_budget(scene, type, budget, progress);
  return parameters.has("resolution") ? fit_by_resolution(scene, type, budget, progress) : Fitted{};
}

void measure_at_bytes(const Scene& scene, const RepresentationType& type, double share, Recorder& recorder,
                      Progress& progress) {
  const double budget = share * static_cast<double>(scene.heightmap_bytes);
  const Fitted fitted = fit(scene, type, budget, progress);
  recorder.add("fits", "", fitted.built ? 1 : 0);
  if (!fitted.built) return;
  recorder.add("setting", "", static_cast<double>(fitted.setting));
  recorder.add("file_bytes", "B", fitted.bytes);
  recorder.add("of_budget", "", static_cast<double>(fitted.bytes) / budget);
  recorder.add("bytes", "B", fitted.built->memory().total());
  record(differences(*fitted.built, scene.source, scene.lines, kMargin * scene.cell), scene.source, recorder);
}

void measure(const Case& at, const RunOptions& options, Recorder& recorder, Progress& progress) {
  const Scene& ground =
      scene({at.terrain, at.integer("size"), at.integer("resolution"), at.integer("lines"), options.seed},
            progress);
  recorder.terrain(ground.source);
  const RepresentationType& type = representation(at.parameters.text("representation"));
  const double share = at.parameters.number("share");
  if (share > 0) {
    measure_at_bytes(ground, type, share, recorder, progress);
    return;
  }
  measure_build(ground, type, recorder, progress);
  const std::unique_ptr<Representation> built = ground.build(type, progress);
  measure_file(ground, type, *built, recorder);
  measure_queries(ground, *built, recorder);
  record(differences(*built, ground.source, ground.lines, kMargin * ground.cell), ground.source, recorder);
  const TriangleMesh mesh = measure_mesh(*built, recorder);
  measure_rays(ground, *built, mesh, at.integer("rays"), recorder);
  measure_edit(ground, type, *built, recorder, progress);
}

}  // namespace

extern const Experiment kRepresentations{
    "cross.representations", "Representations on the same ground, at the same bytes", kSpecs, cases, measure};

}  // namespace terrabench::cross
