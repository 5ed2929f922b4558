#include "representations/drill/profile_fit.h"

#include <algorithm>

#include "representations/drill/cross_sections.h"

namespace terrabench {
namespace {

// The normal equations: sums of r², r³, r⁴, r·y, r²·y.
struct Sums {
  double r2 = 0, r3 = 0, r4 = 0, ry = 0, r2y = 0;
  int samples = 0;
};

Sums sum(std::span<const float> joined, float centre) {
  Sums s;
  for (std::size_t i = 0; i < joined.size(); ++i) {
    if (!CrossSections::is_sample(joined[i])) continue;
    ++s.samples;
    const double r = static_cast<double>(i + 1), r2 = r * r, y = static_cast<double>(joined[i]) - centre;
    s.r2 += r2;
    s.r3 += r2 * r;
    s.r4 += r2 * r2;
    s.ry += r * y;
    s.r2y += r2 * y;
  }
  return s;
}

FittedProfile profile(double slope, double curvature) {
  return {static_cast<float>(slope), static_cast<float>(curvature), true};
}

}  // namespace

FittedProfile fit_profile(std::span<const float> joined, float centre, DrillFit fit) {
  const Sums s = sum(joined, centre);
  if (s.samples == 0) return {};
  if (fit == DrillFit::kVertex) return profile(0, s.r2y / s.r4);
  const double determinant = s.r2 * s.r4 - s.r3 * s.r3;
  const double slope = s.samples == 1 ? s.ry / s.r2 : (s.ry * s.r4 - s.r2y * s.r3) / determinant;
  const double curvature = s.samples == 1 ? 0 : (s.r2y * s.r2 - s.ry * s.r3) / determinant;
  if (fit == DrillFit::kPrinted || (slope >= 0 && curvature >= 0)) return profile(slope, curvature);
  // Two constraints on two unknowns: the least squares solution lies inside, or on one of the bounds. Level
  // at the centre, curvature·r², or straight, slope·r; the squared error falls by the gain below the flat
  // drill's.
  const double bowl = std::max(s.r2y, 0.0) / s.r4, bowl_gain = bowl * s.r2y;
  const double line = std::max(s.ry, 0.0) / s.r2;
  return line * s.ry >= bowl_gain ? profile(line, 0) : profile(0, bowl);
}

}  // namespace terrabench
