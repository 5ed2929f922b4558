// The setting at which a type of representation takes given bytes or has a given error, and every setting
// that was tried for it.
//
// The knob of most types is their resolution, from 4 columns along the ground to its own samples or, for a
// solid, to twice the columns of the scene. Drills choose all their parameters themselves, for given bytes as
// for a given error; of a solid they sample the columns of the scene.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "experiments/cross/representations/scenes.h"

namespace terrabench::cross {

// Settings come in steps and have an end, so that a type may stay far below what it is allowed. Types are
// compared at the same bytes or at the same error only where they take at least this share of it.
inline constexpr double kLeastOfBytes = 0.85, kLeastOfError = 0.9;

struct Trial {
  std::int64_t setting = 0;  // columns, or the bytes that drills were allowed; 0 if they were given an error
  std::size_t file_bytes = 0;
  double rmse = 0, volume_error = 0;  // of tops, metres; 1 - IoU, 0 where neither has volume
};

struct FoundSetting {
  Parameters parameters;
  Trial trial;
};

class SettingSearch {
 public:
  // Keeps references.
  SettingSearch(const Scene&, const RepresentationType&, Progress&);

  // The setting found whose file takes the most bytes, at most `budget`; nothing if there is none; trials()
  // then has the smallest file found. A resolution at which the type cannot hold the ground counts as too
  // coarse. About five builds, for drills one or two.
  std::optional<FoundSetting> for_bytes(double budget);
  // The coarsest setting found whose error is at most `rmse` metres, which is above 0; nothing if the finest
  // setting exceeds it, or the coarsest stays below. About eight builds. Drills that cannot are tried once
  // more for their least error.
  std::optional<FoundSetting> for_error(double rmse);

  // All settings tried so far at which the type held the ground, in order.
  std::span<const Trial> trials() const { return trials_; }

 private:
  bool has(std::string_view parameter) const { return parameters_.has(parameter); }
  std::optional<Trial> attempt(const Parameters&, std::int64_t setting);
  std::optional<FoundSetting> within_budget(double budget);
  std::optional<FoundSetting> finest_within(double budget);
  std::optional<FoundSetting> drills_for_error(double rmse);
  std::optional<FoundSetting> coarsest_for_error(double rmse);

  const Scene& scene_;
  const RepresentationType& type_;
  Progress& progress_;
  Parameters parameters_;
  std::vector<Trial> trials_;
};

}  // namespace terrabench::cross
