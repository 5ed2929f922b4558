// The lattice of triangle corners over a field of any size: R × S root squares of 2ⁿ steps a side, each step
// at most one sample. Bintrees want 2ⁿ + 1 samples a side; a field that has others is met by letting some
// neighbouring lattice lines stand over the same line of samples, spread evenly. Both axes stay monotone, so
// every triangle of a conforming bintree mesh keeps its orientation or has no area, and the field is covered
// exactly, border included, by triangles over real samples.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "terrain/memory.h"

namespace terrabench::roam {

struct Step {
  std::int32_t u, v;
};
// Headings, an eighth turn each, from east over south.
inline constexpr std::array<Step, 8> kSteps = {
    {{1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}}};

struct Lattice {
  int side_log = 0;  // n
  int roots_x = 0, roots_z = 0;
  bool exact = true;                      // each lattice point has a sample of its own
  std::vector<std::int32_t> column, row;  // sample under a lattice line, ascending by 0 or 1

  int width() const { return static_cast<int>(column.size()); }
  int depth() const { return static_cast<int>(row.size()); }
  int finest_level() const { return 2 * side_log; }
  Memory memory() const;
};

// The largest root squares for which the lattice has at most a quarter more points than the field. Fields of
// a·2ⁿ + 1 by b·2ⁿ + 1 samples get an exact one; square ones of any size 17 × 17 root squares at most. A long
// strip gets as many as its width asks for. O(width + depth).
Lattice lattice_over(int width, int depth);

// Lattice steps from the apex of a triangle of a level to the ends of its legs, along each axis that they
// run.
inline int leg_steps(int side_log, int level) { return 1 << (side_log - (level + 1) / 2); }
// ... and to the middle of its hypotenuse.
inline int middle_steps(int side_log, int level) { return (1 << (side_log - level / 2)) / 2; }

}  // namespace terrabench::roam
