// What both kinds of fault formation share: the field, made row by row from the faults. Each fault moves the
// ground by one step up or down; steps are counted, so that their sums are exact in any order.
#pragma once

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <cstdint>
#include <string_view>
#include <vector>

#include "terrain/heightfield.h"
#include "terrain/sources/fractal/limits.h"

namespace terrabench::fractal {

// Throws usage_error. Of FaultOptions or PlanetFaultOptions.
template <class Options>
void check_faults(const Options& options, std::string_view where) {
  constexpr int kMostFaults = 1'000'000;
  check_side(options.width, "width", where);
  check_side(options.depth, "depth", where);
  check_between(options.faults, 0, kMostFaults, "faults", where);
  check_between(options.step, 0, kLargestMetres, "step", where);
}

// A field of width × depth samples whose first `columns` columns hold the sums of all faults, in metres.
// crossings_of(row) returns a function of (fault, sum, turns) that adds what a fault does to that row: to
// `sum`, the steps at its first sample, and to `turns[i]`, how many more there are from sample i on. Parallel
// over rows, O(depth · (faults + width)).
template <class CrossingsOf, class Options>
Heightfield sum_of_faults(const Options& options, int columns, const CrossingsOf& crossings_of) {
  Heightfield field = Heightfield::zeros(options.width, options.depth);
  constexpr int kRowsPerTask = 16;
  tbb::parallel_for(tbb::blocked_range<int>(0, options.depth, kRowsPerTask), [&](const auto& rows) {
    std::vector<int> turns;
    for (int j = rows.begin(); j < rows.end(); ++j) {
      turns.assign(static_cast<std::size_t>(columns) + 1, 0);
      int sum = 0;
      const auto cross = crossings_of(j);
      for (std::size_t k = 0; k < static_cast<std::size_t>(options.faults); ++k) cross(k, sum, turns);
      for (int i = 0; i < columns; ++i) {
        sum += turns[static_cast<std::size_t>(i)];
        field.at(i, j) = static_cast<float>(sum * static_cast<double>(options.step));
      }
    }
  });
  return field;
}

}  // namespace terrabench::fractal
