// The coarsest setting at which a type of representation has a given error.
//
// The knob of most types is their resolution, from 4 columns along the ground to its own samples or, for a
// solid, to twice the columns of the scene; of a TIN the largest error that it allows. Drills choose all
// their parameters themselves; of a solid they sample the columns of the scene.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "experiments/cross/lod/knob_search.h"
#include "experiments/cross/representations/scenes.h"

namespace terrabench::cross {

// Settings come in steps and have an end, so that a type may stay far below what it is allowed. Types are
// compared at the same error only where they take at least this share of it.
inline constexpr double kLeastOfError = 0.9;

struct Trial {
  double setting = 0;     // columns, or metres of a TIN; 0 of drills
  std::size_t bytes = 0;  // in memory
  double rmse = 0;        // of tops, metres
};

struct FoundSetting {
  Parameters parameters;
  Trial trial;
};

class SettingSearch {
 public:
  // Keeps references.
  SettingSearch(const Scene&, const RepresentationType&, Progress&);

  // The coarsest setting found whose error is at most `rmse` metres, which is above 0; nothing if the finest
  // setting exceeds it, or the coarsest stays below. About eight builds. Drills that cannot are tried once
  // more for their least error.
  std::optional<FoundSetting> for_error(double rmse);

  // All settings tried so far at which the type held the ground, in order.
  std::span<const Trial> trials() const { return trials_; }

 private:
  bool has(std::string_view parameter) const { return parameters_.has(parameter); }
  std::optional<Trial> attempt(const Parameters&, double setting);
  std::optional<FoundSetting> drills_for_error(double rmse);
  std::optional<FoundSetting> coarsest_for_error(const Knob&, double rmse);

  const Scene& scene_;
  const RepresentationType& type_;
  Progress& progress_;
  Parameters parameters_;
  std::vector<Trial> trials_;
};

}  // namespace terrabench::cross
