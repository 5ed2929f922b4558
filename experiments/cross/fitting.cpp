#include "experiments/cross/fitting.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "experiments/cross/knob_search.h"
#include "terrain/error.h"
#include "terrain/events/event.h"

namespace terrabench::cross {
namespace {

constexpr int kCoarsest = 4;  // columns

double longest_side(const Scene& scene) {
  return scene.source.heights ? std::max(scene.source.heights->width, scene.source.heights->depth)
                              : scene.options.resolution;
}

Knob resolution_knob(const Scene& scene) {
  const double own = longest_side(scene), finest = scene.source.heights ? own : 2 * own;
  // Other samples than a sculpture's own may have no room for its tunnels.
  const double first = scene.source.events ? scene.source.events->ground.width - 1 : std::round(own / 4);
  return {"resolution", "", finest, kCoarsest, std::max<double>(kCoarsest, first), true};
}

Parameters with(Parameters parameters, std::string_view name, std::int64_t setting) {
  parameters.set(name, setting);
  return parameters;
}

}  // namespace

Fitting::Fitting(const Scene& scene, const RepresentationType& type, Progress& progress)
    : scene_(scene), type_(type), progress_(progress), parameters_(scene.parameters(type)) {}

// Nothing where the type refuses the setting.
std::optional<Trial> Fitting::attempt(const Parameters& parameters, std::int64_t setting) {
  try {
    const auto built = type_.build(scene_.source, parameters, progress_);
    const Differences found = top_and_volume_differences(*built, scene_.source, scene_.lines);
    return trials_.emplace_back(Trial{setting, file_bytes(type_, *built), found.rmse, 1 - found.volume_iou});
  } catch (const Error& error) {
    if (error.code() != ExitCode::kBadInput && error.code() != ExitCode::kUsage) throw;
    return {};
  }
}

// For types that choose their settings for a budget. The budget excludes the file's own head, which the first
// attempt tells.
std::optional<Fitted> Fitting::within_budget(double budget) {
  double asked = budget;
  for (int k = 0; k < 2 && asked >= 1; ++k) {
    const auto setting = static_cast<std::int64_t>(std::llround(asked));
    const Parameters parameters = with(parameters_, "budget_bytes", setting);
    const std::optional<Trial> trial = attempt(parameters, setting);
    if (!trial) return {};
    const double excess = static_cast<double>(trial->file_bytes) - budget;
    if (excess <= 0) return Fitted{parameters, *trial};
    asked = budget - excess;
  }
  return {};
}

std::optional<Fitted> Fitting::finest_within(double budget) {
  constexpr int kProbes = 8;
  constexpr double kClose = 0.95;
  std::optional<Fitted> best;
  double low = kCoarsest, high = longest_side(scene_);
  for (int k = 0; k < kProbes; ++k) {
    const auto resolution = static_cast<std::int64_t>(k == 0 ? high : std::sqrt(low * high));
    if (k > 0 && static_cast<double>(resolution) <= low) break;
    const Parameters parameters = scene_.parameters(type_, resolution);
    const std::optional<Trial> trial = attempt(parameters, resolution);
    const bool fits = !trial || static_cast<double>(trial->file_bytes) <= budget;
    (fits ? low : high) = static_cast<double>(resolution);
    if (!fits || !trial) continue;
    if (!best || trial->file_bytes > best->trial.file_bytes) best = Fitted{parameters, *trial};
    if (k == 0 || static_cast<double>(trial->file_bytes) >= kClose * budget) break;
  }
  return best;
}

std::optional<Fitted> Fitting::for_bytes(double budget) {
  if (has("budget_bytes")) return within_budget(budget);
  return has("resolution") ? finest_within(budget) : std::nullopt;
}

std::optional<Fitted> Fitting::drills_for_error(double rmse) {
  constexpr double kNoLimit = 1e12;  // bytes
  Parameters parameters = parameters_;
  parameters.set("max_rmse", rmse);
  const std::optional<Trial> trial = attempt(parameters, 0);
  if (!trial) attempt(with(parameters_, "budget_bytes", static_cast<std::int64_t>(kNoLimit)), 0);
  // On a solid the drills' own error is that of the columns, to which that of sampling them is added.
  return trial && trial->rmse <= rmse ? std::optional(Fitted{parameters, *trial}) : std::nullopt;
}

std::optional<Fitted> Fitting::coarsest_for_error(double rmse) {
  std::optional<Fitted> best;
  const Tuned tuned = search_knob(resolution_knob(scene_), rmse, [&](double value) {
    const auto setting = static_cast<std::int64_t>(value);
    const Parameters parameters = scene_.parameters(type_, setting);
    const std::optional<Trial> trial = attempt(parameters, setting);
    if (!trial) return std::numeric_limits<double>::infinity();
    if (trial->rmse <= rmse && (!best || trial->file_bytes < best->trial.file_bytes)) {
      best = Fitted{parameters, *trial};
    }
    return trial->rmse;
  });
  return tuned.reached ? best : std::nullopt;
}

std::optional<Fitted> Fitting::for_error(double rmse) {
  if (has("max_rmse")) return drills_for_error(rmse);
  return has("resolution") ? coarsest_for_error(rmse) : std::nullopt;
}

}  // namespace terrabench::cross
