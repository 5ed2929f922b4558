// Fractal gradient noise on a lattice of whole points: the graph's fbm (graph.h) in the plane y = 0, with
// octaves of 2ᵏ points per cell, so that cell and fraction come from the bits of the point. The coordinates
// are exact at any distance from 0: ground made of it has no border and nowhere becomes coarser. A pure
// function of seed and point, the same on every instruction set.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "terrain/memory.h"
#include "terrain/sources/noise/code.h"

namespace terrabench::noise {

struct LatticeFractal {
  std::uint64_t seed = 0;
  int cell_bits = 11;  // the first octave has 2^cell_bits points per cell; 1 … 15
  int octaves = 10;    // each with half the cell of the one before; 1 … cell_bits + 1
  float gain = 0.5F;   // each octave's weight as a share of the one before
};

class LatticeNoise {
 public:
  // Throws usage_error for octaves outside their range.
  explicit LatticeNoise(const LatticeFractal&);

  // Values in [-1, 1] at (x[k], z[k]); all three have one length. Where float coordinates are exact they are
  // those of Graph::fbm with frequency 2^-cell_bits, to the bit. O(octaves) a point. Thread-safe.
  void points(std::span<const std::int32_t> x, std::span<const std::int32_t> z, std::span<float> out) const;

  std::size_t heap_bytes() const { return terrabench::heap_bytes(octaves_.data()); }

 private:
  int cell_bits_;
  std::vector<Octave> octaves_;
};

}  // namespace terrabench::noise
