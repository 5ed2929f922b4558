// The quadratic fitted to the union of a drill's cross-sections (Stuetzle & Franklin 2012, §2.2).
#pragma once

#include <limits>
#include <span>

namespace terrabench {

struct FittedProfile {
  float slope = 0, curvature = 0;
  bool determined = false;  // false when the union holds no sample
};

// How far from the centre a shape must not fall, in samples.
inline constexpr double kRisesNowhere = 0, kRisesEverywhere = std::numeric_limits<double>::infinity();

// Least squares of slope·r + curvature·r² against joined[r - 1] - centre for r = 1 … w, so that the curve
// passes through the centre, under the constraint that it does not fall up to r = `rises_to`. Distances
// without a sample are ignored; with a single sample the curve is a line. O(w).
FittedProfile fit_profile(std::span<const float> joined, float centre, double rises_to);

}  // namespace terrabench
