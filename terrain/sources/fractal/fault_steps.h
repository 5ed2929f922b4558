// How far each fault moves the ground, as whole numbers of a small unit, so that sums of steps are exact in
// any order.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

namespace terrabench::fractal {

struct FaultSteps {
  double unit = 0;  // metres
  std::vector<std::int64_t> whole;
  float metres(std::int64_t sum) const { return static_cast<float>(static_cast<double>(sum) * unit); }
};

// Fault k moves by step · decay^k, but never less than `least`. Throws usage_error. O(faults).
FaultSteps fault_steps(int faults, float step, float decay, float least, std::string_view where);

// The sum so far becomes the height, crossing by crossing: `turns[i]` is what changes at sample i. Leaves the
// turns at zero for the next row. O(width).
void write_row(const FaultSteps&, std::int64_t sum, std::vector<std::int64_t>& turns, int width, float* row);

}  // namespace terrabench::fractal
