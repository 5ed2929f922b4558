#include "representations/drill/quantum.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "terrain/error.h"

namespace terrabench {

Quanta::Quanta(double quantum, int w)
    : elevation(quantum),
      slope(quantum / std::bit_floor(static_cast<unsigned>(w))),
      curvature(slope / std::bit_floor(static_cast<unsigned>(w))) {}

std::int32_t in_quanta(float value, double quantum) {
  return static_cast<std::int32_t>(std::lround(value / quantum));
}

float in_metres(std::int32_t number, double quantum) { return static_cast<float>(number * quantum); }

void quantise(Drills& drills, float quantum) {
  if (!(quantum >= kLeastQuantum && quantum <= kMostQuantum)) {
    throw usage_error(
        fmt::format("quantum must be between {} and {} m, got {}", kLeastQuantum, kMostQuantum, quantum),
        "drill", "drills are rounded to multiples of it");
  }
  const Quanta quanta(quantum, drills.w);
  const auto round = [&](std::vector<float>& values, double step) {
    for (float& value : values) {
      if (!(std::abs(value / step) < kMostQuanta)) {
        throw usage_error(fmt::format("a quantum of {} m is too fine for this terrain", quantum), "drill",
                          "choose a larger quantum, or 0 for an automatic one");
      }
      value = in_metres(in_quanta(value, step), step);
    }
  };
  round(drills.elevation, quanta.elevation);
  round(drills.slope, quanta.slope);
  round(drills.curvature, quanta.curvature);
  drills.quantum = quantum;
}

float automatic_quantum(const Heightfield& field) {
  const HeightRange range = height_range(field);
  if (range.no_data == field.heights.size()) return 1;
  const float largest = std::max(std::abs(range.lowest), std::abs(range.highest));
  const float wanted = std::max((range.highest - range.lowest) / 256, largest / (kMostQuanta / 2));
  if (!(wanted > 0)) return 1;
  return std::clamp(std::exp2(std::floor(std::log2(wanted))), kLeastQuantum, kMostQuantum);
}

}  // namespace terrabench
