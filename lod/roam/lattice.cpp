#include "lod/roam/lattice.h"

#include <cassert>

#include "terrain/memory.h"

namespace terrabench::roam {
namespace {

std::int64_t rounded_up(int cells, int side_log) {
  const std::int64_t side = std::int64_t{1} << side_log;
  return (cells + side - 1) / side * side;
}

std::vector<std::int32_t> samples_under(std::int64_t steps, int cells) {
  std::vector<std::int32_t> samples(static_cast<std::size_t>(steps) + 1);
  for (std::int64_t u = 0; u <= steps; ++u) samples[u] = static_cast<std::int32_t>(u * cells / steps);
  return samples;
}

}  // namespace

Lattice lattice_over(int width, int depth) {
  assert(width > 1 && depth > 1);
  const int x = width - 1, z = depth - 1;
  int n = 30;
  while (static_cast<double>(rounded_up(x, n)) * static_cast<double>(rounded_up(z, n)) >
         1.25 * static_cast<double>(x) * z) {
    --n;
  }
  const std::int64_t steps_x = rounded_up(x, n), steps_z = rounded_up(z, n);
  Lattice lattice;
  lattice.side_log = n;
  lattice.roots_x = static_cast<int>(steps_x >> n);
  lattice.roots_z = static_cast<int>(steps_z >> n);
  lattice.exact = steps_x == x && steps_z == z;
  lattice.column = samples_under(steps_x, x);
  lattice.row = samples_under(steps_z, z);
  return lattice;
}

Memory Lattice::memory() const { return index_memory(column, row); }

}  // namespace terrabench::roam
