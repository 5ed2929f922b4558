// Fractal gradient noise on a lattice of whole points: the graph's fbm (graph.h) in the plane y = 0, with
// octaves of 2ᵏ points a cell, so that cell and fraction come from the bits of the point. Nothing rounds
// however far from 0 the point lies: ground made of it has no border and no place where it grows coarse. A
// pure function of seed and point, the same on every instruction set.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "terrain/sources/noise/code.h"

namespace terrabench::noise {

struct LatticeFractal {
  std::uint64_t seed = 0;
  int cell_bits = 11;  // the first octave has 2^cell_bits points a cell; 1 … 15
  int octaves = 10;    // each of half the cell of the one before; 1 … cell_bits + 1
  float gain = 0.5F;   // each octave's weight as a share of the one before
};

class LatticeNoise {
 public:
  // Throws usage_error for octaves outside their range.
  explicit LatticeNoise(const LatticeFractal&);

  // Values in [-1, 1] at (x[k], z[k]); the three are equally long. Where float coordinates are exact they are
  // those of Graph::fbm with frequency 2^-cell_bits, to the bit. O(octaves) a point. Safe from many threads
  // at once.
  void points(std::span<const std::int32_t> x, std::span<const std::int32_t> z, std::span<float> out) const;

  std::size_t heap_bytes() const { return octaves_.capacity() * sizeof(Octave); }

 private:
  int cell_bits_;
  std::vector<Octave> octaves_;
};

}  // namespace terrabench::noise
