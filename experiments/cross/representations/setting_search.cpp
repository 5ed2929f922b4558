#include "experiments/cross/representations/setting_search.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "terrain/error.h"
#include "terrain/events/event.h"

namespace terrabench::cross {
namespace {

constexpr int kCoarsest = 4;  // columns

// Between the own samples of a ground that events made; 0 for other ground. Trees of heightmaps start there,
// since other samples may have no room for the ground's tunnels; when tuned for an error, all types do.
int columns_of_events(const Scene& scene) {
  if (!scene.source.events) return 0;
  const Heightfield& ground = scene.source.events->ground;
  return std::max(ground.width, ground.depth) - 1;
}

// The finest resolution: a height field's own samples, twice the columns of a solid.
double most_columns(const Scene& scene) {
  if (scene.source.heights) return std::max(scene.source.heights->width, scene.source.heights->depth);
  return std::max(2 * scene.options.resolution, columns_of_events(scene));
}

Knob resolution_knob(const Scene& scene) {
  const double most = most_columns(scene), guess = std::round(scene.source.heights ? most / 4 : most / 8);
  const double first = scene.source.events ? columns_of_events(scene) : guess;
  const double coarsest = std::min<double>(kCoarsest, most);
  return {"resolution", "", most, coarsest, std::max(coarsest, first), true};
}

// In 4096ths of the relief, so that it comes in steps as a resolution does.
constexpr double kErrorSteps = 4096;
Knob error_knob() { return {"max_error", "", 1, kErrorSteps / 4, kErrorSteps / 128, true}; }

}  // namespace

SettingSearch::SettingSearch(const Scene& scene, const RepresentationType& type, Progress& progress)
    : scene_(scene), type_(type), progress_(progress), parameters_(scene.parameters(type)) {}

// Nothing where the type refuses the setting, or keeps no column whose top could be compared.
std::optional<Trial> SettingSearch::attempt(const Parameters& parameters, double setting) {
  try {
    const auto built = type_.build(scene_.source, parameters, progress_);
    const Differences found = top_and_volume_differences(*built, scene_.source, scene_.lines);
    if (found.columns == 0) return {};
    return trials_.emplace_back(Trial{setting, built->memory().total(), found.rmse});
  } catch (const Error& error) {
    if (!refuses(error)) throw;
    return {};
  }
}

std::optional<FoundSetting> SettingSearch::drills_for_error(double rmse) {
  constexpr std::int64_t kNoLimit = 1'000'000'000'000;  // bytes
  Parameters parameters = parameters_;
  parameters.set("max_rmse", rmse);
  const std::optional<Trial> trial = attempt(parameters, 0);
  if (!trial) {
    Parameters unlimited = parameters_;
    unlimited.set("budget_bytes", kNoLimit);
    attempt(unlimited, 0);
  }
  // On a solid the drills' own error is that of the columns, to which that of sampling them is added.
  return trial && trial->rmse <= rmse ? std::optional(FoundSetting{parameters, *trial}) : std::nullopt;
}

std::optional<FoundSetting> SettingSearch::coarsest_for_error(const Knob& knob, double rmse) {
  std::optional<FoundSetting> best;
  const Tuned tuned = search_knob(knob, rmse, [&](double value) {
    Parameters parameters = parameters_;
    if (knob.name == "max_error") {
      parameters.set(knob.name, value / kErrorSteps * relief_of(scene_));
    } else {
      parameters = scene_.parameters(type_, static_cast<std::int64_t>(value));
    }
    const std::optional<Trial> trial = attempt(parameters, value);
    if (!trial) return std::numeric_limits<double>::infinity();
    if (trial->rmse <= rmse && (!best || trial->bytes < best->trial.bytes))
      best = FoundSetting{parameters, *trial};
    return trial->rmse;
  });
  return tuned.reached ? best : std::nullopt;
}

std::optional<FoundSetting> SettingSearch::for_error(double rmse) {
  if (has("max_rmse")) return drills_for_error(rmse);
  if (has("max_error")) return coarsest_for_error(error_knob(), rmse);
  return has("resolution") ? coarsest_for_error(resolution_knob(scene_), rmse) : std::nullopt;
}

}  // namespace terrabench::cross
