// What both kinds of fault formation share: how far each fault moves the ground, as whole numbers of a small
// unit, so that sums of steps are exact in any order; and the field, made row by row from the faults.
#pragma once

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <cstdint>
#include <string_view>
#include <vector>

#include "terrain/heightfield.h"

namespace terrabench::fractal {

struct FaultSteps {
  double unit = 0;  // metres
  std::vector<std::int64_t> whole;
  float metres(std::int64_t sum) const { return static_cast<float>(static_cast<double>(sum) * unit); }
};

// Fault k moves the ground by step · decay^k, but never by less than `least_step`: of FaultOptions or
// PlanetFaultOptions. Throws usage_error. O(faults).
FaultSteps fault_steps(int faults, float step, float decay, float least, std::string_view where);
template <class Options>
FaultSteps fault_steps(const Options& options, std::string_view where) {
  return fault_steps(options.faults, options.step, options.decay, options.least_step, where);
}

// The heights of one row, west to east: `sum` steps at its first sample, `turns[i]` more from sample i on.
// Leaves the turns at zero for the next row. O(width).
void write_row(const FaultSteps&, std::int64_t sum, std::vector<std::int64_t>& turns, int width, float* row);

// A field of width × depth samples whose first `columns` columns hold the sums of all faults.
// crossings_of(row) returns a function of (fault, step, sum, turns) that adds what a fault does to that row,
// sum and turns as in write_row(). Parallel over rows.
template <class CrossingsOf>
Heightfield sum_of_faults(const FaultSteps& steps, int width, int depth, int columns,
                          const CrossingsOf& crossings_of) {
  Heightfield field = Heightfield::zeros(width, depth);
  constexpr int kRowsPerTask = 16;
  tbb::parallel_for(tbb::blocked_range<int>(0, depth, kRowsPerTask), [&](const auto& rows) {
    std::vector<std::int64_t> turns(static_cast<std::size_t>(columns) + 1);
    for (int j = rows.begin(); j < rows.end(); ++j) {
      std::int64_t sum = 0;
      const auto cross = crossings_of(j);
      for (std::size_t k = 0; k < steps.whole.size(); ++k) cross(k, steps.whole[k], sum, turns);
      write_row(steps, sum, turns, columns, &field.at(0, j));
    }
  });
  return field;
}

}  // namespace terrabench::fractal
