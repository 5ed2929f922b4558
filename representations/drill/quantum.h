// Rounding of drills to whole multiples of a quantum, so that they can be coded as integers. The paper stores
// plain values; it says nothing of their precision.
#pragma once

#include <cstdint>

#include "representations/drill/drills.h"
#include "terrain/heightfield.h"

namespace terrabench {

inline constexpr float kLeastQuantum = 1e-9F, kMostQuantum = 1e6F;  // metres
// The largest number of quanta: its product with any quantum rounds back to the same number.
inline constexpr std::int32_t kMostQuanta = 1 << 22;

// The steps for each of a drill's numbers, in metres, metres per sample and metres per sample².
struct Quanta {
  double elevation, slope, curvature;
  Quanta(double quantum, int w);
};
std::int32_t in_quanta(float value, double quantum);
float in_metres(std::int32_t number, double quantum);

// Rounds elevations to whole multiples of `quantum` metres, and slope and curvature to quantum / 2^⌊log₂ w⌋
// and quantum / 4^⌊log₂ w⌋, so that the shape is about as exact w samples from the pixel. Rounding keeps
// every order: what was monotone stays so. Throws usage_error when `quantum` lies outside [kLeastQuantum,
// kMostQuantum], or is so fine that a number exceeds kMostQuanta.
void quantise(Drills& drills, float quantum);

// A power of two near 1/256 of the range of heights. The drills' own error is about 2 % of the range, so that
// such rounding hardly adds to it.
float automatic_quantum(const Heightfield& field);

}  // namespace terrabench
