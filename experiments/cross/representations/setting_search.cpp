#include "experiments/cross/representations/setting_search.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "experiments/cross/lod/knob_search.h"
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

Parameters with(Parameters parameters, std::string_view name, std::int64_t setting) {
  parameters.set(name, setting);
  return parameters;
}

}  // namespace

SettingSearch::SettingSearch(const Scene& scene, const RepresentationType& type, Progress& progress)
    : scene_(scene), type_(type), progress_(progress), parameters_(scene.parameters(type)) {}

// Nothing where the type refuses the setting, or keeps no column whose top could be compared.
std::optional<Trial> SettingSearch::attempt(const Parameters& parameters, std::int64_t setting) {
  try {
    const auto built = type_.build(scene_.source, parameters, progress_);
    const Differences found = top_and_volume_differences(*built, scene_.source, scene_.lines);
    if (found.columns == 0) return {};
    return trials_.emplace_back(
        Trial{setting, file_bytes(type_, *built), found.rmse, 1 - found.volume_iou.value_or(1)});
  } catch (const Error& error) {
    if (!refuses(error)) throw;
    return {};
  }
}

// For types that choose their settings for a budget. The budget excludes the file's own head, which the first
// attempt tells.
std::optional<FoundSetting> SettingSearch::within_budget(double budget) {
  double asked = budget;
  for (int k = 0; k < 2 && asked >= 1; ++k) {
    const auto setting = static_cast<std::int64_t>(std::llround(asked));
    const Parameters parameters = with(parameters_, "budget_bytes", setting);
    const std::optional<Trial> trial = attempt(parameters, setting);
    if (!trial) return {};
    const double excess = static_cast<double>(trial->file_bytes) - budget;
    if (excess <= 0) return FoundSetting{parameters, *trial};
    asked = budget - excess;
  }
  return {};
}

// Bytes grow about as the square of the columns; their square root is searched, because search_knob() expects
// an error proportional to the knob. Its finest end is here the fewest columns, whose file is the smallest.
std::optional<FoundSetting> SettingSearch::finest_within(double budget) {
  std::optional<FoundSetting> best;
  const double most = most_columns(scene_);
  const double own = scene_.source.heights ? most : static_cast<double>(scene_.options.resolution);
  const double guess = std::round(own * std::sqrt(budget / static_cast<double>(scene_.heightmap_bytes))),
               first = scene_.source.events && has("events") ? columns_of_events(scene_) : guess;
  const double least = std::min<double>(kCoarsest, most);
  const Knob knob{"resolution", "", least, most, std::clamp(first, least, most), true};
  search_knob(knob, std::sqrt(budget), [&](double value) {
    const auto columns = static_cast<std::int64_t>(value);
    const Parameters parameters = scene_.parameters(type_, columns);
    const std::optional<Trial> trial = attempt(parameters, columns);
    if (!trial) return -std::numeric_limits<double>::infinity();
    const auto bytes = static_cast<double>(trial->file_bytes);
    if (bytes <= budget && (!best || trial->file_bytes > best->trial.file_bytes)) {
      best = FoundSetting{parameters, *trial};
    }
    return std::sqrt(bytes);
  });
  return best;
}

std::optional<FoundSetting> SettingSearch::for_bytes(double budget) {
  if (has("budget_bytes")) return within_budget(budget);
  return has("resolution") ? finest_within(budget) : std::nullopt;
}

std::optional<FoundSetting> SettingSearch::drills_for_error(double rmse) {
  constexpr double kNoLimit = 1e12;  // bytes
  Parameters parameters = parameters_;
  parameters.set("max_rmse", rmse);
  const std::optional<Trial> trial = attempt(parameters, 0);
  if (!trial) attempt(with(parameters_, "budget_bytes", static_cast<std::int64_t>(kNoLimit)), 0);
  // On a solid the drills' own error is that of the columns, to which that of sampling them is added.
  return trial && trial->rmse <= rmse ? std::optional(FoundSetting{parameters, *trial}) : std::nullopt;
}

std::optional<FoundSetting> SettingSearch::coarsest_for_error(double rmse) {
  std::optional<FoundSetting> best;
  const Tuned tuned = search_knob(resolution_knob(scene_), rmse, [&](double value) {
    const auto setting = static_cast<std::int64_t>(value);
    const Parameters parameters = scene_.parameters(type_, setting);
    const std::optional<Trial> trial = attempt(parameters, setting);
    if (!trial) return std::numeric_limits<double>::infinity();
    if (trial->rmse <= rmse && (!best || trial->file_bytes < best->trial.file_bytes)) {
      best = FoundSetting{parameters, *trial};
    }
    return trial->rmse;
  });
  return tuned.reached ? best : std::nullopt;
}

std::optional<FoundSetting> SettingSearch::for_error(double rmse) {
  if (has("max_rmse")) return drills_for_error(rmse);
  return has("resolution") ? coarsest_for_error(rmse) : std::nullopt;
}

}  // namespace terrabench::cross
