// The lattice of triangle corners over a field of any size: R × S root squares of 2ⁿ × 2ⁿ steps, each step at
// most one sample. Binary triangle trees need 2ⁿ + 1 samples per side; over a field of another size, some
// neighbouring lattice lines, spread evenly, lie over the same line of samples. Both axes stay monotone, so
// every triangle of a conforming mesh keeps its orientation or has no area, and triangles over actual samples
// cover the field exactly, border included.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "terrain/memory.h"

namespace terrabench::roam {

struct Step {
  std::int32_t u, v;
};
// The eight headings, clockwise from east (east, south-east, south, …).
inline constexpr std::array<Step, 8> kSteps = {
    {{1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}}};

struct Lattice {
  int side_log = 0;  // n
  int roots_x = 0, roots_z = 0;
  bool exact = true;                      // no two lattice points share a sample
  std::vector<std::int32_t> column, row;  // sample under each lattice line, ascending by 0 or 1

  int width() const { return static_cast<int>(column.size()); }
  int depth() const { return static_cast<int>(row.size()); }
  int finest_level() const { return 2 * side_log; }
  Memory memory() const;
};

// The lattice with the largest root squares that has at most a quarter more points than the field. It is
// exact for fields of a·2ⁿ + 1 by b·2ⁿ + 1 samples. Square fields get at most 17 × 17 root squares; for long
// strips the shorter side determines the size. O(width + depth).
Lattice lattice_over(int width, int depth);

// Lattice steps from a triangle's apex to the ends of its legs, along each axis on which they advance.
inline int leg_steps(int side_log, int level) { return 1 << (side_log - (level + 1) / 2); }
// Lattice steps from the apex to the middle of the hypotenuse, likewise.
inline int middle_steps(int side_log, int level) { return (1 << (side_log - level / 2)) / 2; }

}  // namespace terrabench::roam
