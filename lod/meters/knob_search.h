// Finds the setting of a method's knob that gives a required error, by bisection on a logarithmic scale with
// interpolation between the ends of the bracket.
#pragma once

#include <functional>

#include "lod/lod.h"

namespace terrabench {

struct Tuned {
  double knob = 0, error = 0;
  // The error is at most the target, and within kKnobSlack of it unless the next coarser setting exceeds it.
  // False also where even the coarsest setting stays below, or where all settings before the first that
  // exceeds it are refused: such a method is not at the required error.
  bool reached = false;
};

// The search ends at an error between (1 - kKnobSlack) · target and the target.
inline constexpr double kKnobSlack = 0.02;

// The coarsest setting found with error ≤ target; the finest one where even that exceeds the target. About
// six calls of error_at(knob), which should rise from finest to coarsest; infinite at settings that are
// refused for being too coarse, minus infinite at those that are refused for being too fine.
Tuned search_knob(const Knob&, double target, const std::function<double(double)>& error_at);

}  // namespace terrabench
