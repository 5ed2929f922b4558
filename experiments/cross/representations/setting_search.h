// The coarsest setting at which a type of representation has a given error.
//
// The error of heights is the RMSE of their tops. That of a solid is the volume that type and ground do not
// share (1 - IoU), or a twentieth of the same share of the air under overhangs if that is more: the air is a
// small part of the volume, and what fills all of it would else have almost no error. Both are measured on
// random lines.
//
// The knob of most types is their resolution, from 4 columns along the ground to its own samples or, for a
// solid, to three times the columns of the scene; of a TIN the largest error that it allows. Drills choose
// all their parameters themselves; of a solid they sample the columns of the scene.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "experiments/cross/representations/scenes.h"
#include "lod/meters/knob_search.h"

namespace terrabench::cross {

// Allowed error of the air under overhangs ÷ allowed error of the volume.
inline constexpr double kAirError = 20;

struct Trial {
  double setting = 0;     // columns, or metres of a TIN; 0 of drills
  std::size_t bytes = 0;  // in memory
  double error = 0;       // metres, of a solid a share
};

struct FoundSetting {
  Parameters parameters;
  Trial trial;
};

class SettingSearch {
 public:
  // Keeps references.
  SettingSearch(const Scene&, const RepresentationType&, Progress&);

  // The coarsest setting found whose error is at most `most`, which is above 0; nothing if the finest setting
  // exceeds it. Settings come in steps and have an end, so that a type may stay below the error, at its own
  // expense. About eight builds. Drills that cannot are tried once more for
  // their least error.
  std::optional<FoundSetting> for_error(double most);

  // All settings tried so far at which the type held the ground, in order.
  std::span<const Trial> trials() const { return trials_; }

 private:
  bool has(std::string_view parameter) const { return parameters_.has(parameter); }
  std::optional<Trial> attempt(const Parameters&, double setting);
  double error_of(const Representation&) const;
  std::optional<FoundSetting> drills_for_error(double most);
  std::optional<FoundSetting> coarsest_for_error(const Knob&, double most);

  const Scene& scene_;
  const RepresentationType& type_;
  Progress& progress_;
  Parameters parameters_;
  std::vector<Trial> trials_;
};

}  // namespace terrabench::cross
