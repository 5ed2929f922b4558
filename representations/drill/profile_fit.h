// The quadratic fitted to the union of a drill's cross-sections (Stuetzle & Franklin 2012, §2.2).
#pragma once

#include <span>

namespace terrabench {

// Which quadratic function is fitted. All pass through the centre.
enum class DrillFit {
  kPrinted,  // §2.2: free but for the centre; may bend down, and then falls without end beyond w
  kVertex,   // curvature·r², with its vertex at the pixel: position, elevation and curvature are the
             // four values that §4.1 counts
  kMonotone  // as §4 says of the shapes: slope and curvature ≥ 0
};

struct FittedProfile {
  float slope = 0, curvature = 0;
  bool determined = false;  // false when the union holds no sample
};

// Least squares of slope·r + curvature·r² against joined[r - 1] - centre for r = 1 … w, under the fit's
// constraint. Distances without a sample are ignored; with a single sample the curve is a line, that of
// kVertex still a parabola. O(w).
FittedProfile fit_profile(std::span<const float> joined, float centre, DrillFit fit);

}  // namespace terrabench
