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

// The finest resolution: a height field's own samples, three times the columns of a solid.
double most_columns(const Scene& scene) {
  if (scene.source.heights) return std::max(scene.source.heights->width, scene.source.heights->depth);
  return std::max(3 * scene.options.resolution, columns_of_events(scene));
}

Knob resolution_knob(const Scene& scene) {
  const double most = most_columns(scene),
               guess = scene.source.heights ? std::round(most / 4) : scene.options.resolution;
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

// Of heights, NaN for a type that keeps no column whose top could be compared.
double SettingSearch::error_of(const Representation& built) const {
  if (scene_.source.solid) {
    const VolumeErrors errors = volume_errors(built, scene_.random);
    return std::max(errors.volume, errors.air / kAirError);
  }
  const Differences found = top_and_volume_differences(built, scene_.source, scene_.lines);
  return found.columns == 0 ? std::numeric_limits<double>::quiet_NaN() : found.rmse;
}

// Nothing where the type refuses the setting, or has no error.
std::optional<Trial> SettingSearch::attempt(const Parameters& parameters, double setting) {
  try {
    const auto built = type_.build(scene_.source, parameters, progress_);
    const double error = error_of(*built);
    if (std::isnan(error)) return {};
    return trials_.emplace_back(Trial{setting, built->memory().total(), error});
  } catch (const Error& error) {
    if (!refuses(error)) throw;
    return {};
  }
}

std::optional<FoundSetting> SettingSearch::drills_for_error(double most) {
  constexpr std::int64_t kNoLimit = 1'000'000'000'000;  // bytes
  Parameters limited = parameters_, unlimited = parameters_;
  limited.set("max_rmse", most);
  unlimited.set("budget_bytes", kNoLimit);
  // They can be asked for an error of tops alone.
  const Parameters& asked = scene_.source.solid ? unlimited : limited;
  const std::optional<Trial> trial = attempt(asked, 0);
  if (!trial && scene_.source.heights) attempt(unlimited, 0);
  return trial && trial->error <= most ? std::optional(FoundSetting{asked, *trial}) : std::nullopt;
}

std::optional<FoundSetting> SettingSearch::coarsest_for_error(const Knob& knob, double most) {
  std::optional<FoundSetting> best;
  search_knob(knob, most, [&](double value) {
    Parameters parameters = parameters_;
    if (knob.name == "max_error") {
      parameters.set(knob.name, value / kErrorSteps * relief_of(scene_));
    } else {
      parameters = scene_.parameters(type_, static_cast<std::int64_t>(value));
    }
    const std::optional<Trial> trial = attempt(parameters, value);
    if (!trial) return std::numeric_limits<double>::infinity();
    if (trial->error <= most && (!best || trial->bytes < best->trial.bytes))
      best = FoundSetting{parameters, *trial};
    return trial->error;
  });
  return best;
}

std::optional<FoundSetting> SettingSearch::for_error(double most) {
  if (has("max_rmse")) return drills_for_error(most);
  if (has("max_error")) return coarsest_for_error(error_knob(), most);
  return has("resolution") ? coarsest_for_error(resolution_knob(scene_), most) : std::nullopt;
}

}  // namespace terrabench::cross
