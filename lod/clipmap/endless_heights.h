// Ground without bounds, computed where a clipmap asks for it (the endless terrain of the hybrid paper,
// §3.2): fractal noise at whole samples, a pure function of seed and sample, so that no window depends on the
// way to it and a walk there and back finds the same heights to the bit.
#pragma once

#include <cstdint>
#include <memory>

#include "lod/clipmap/height_source.h"

namespace terrabench {

struct EndlessGround {
  std::uint64_t seed = 0;
  float cell = 30;      // metres between samples
  float relief = 6000;  // metres at a noise of 1; heights lie within ± this, nearly all within a third
  int cell_bits = 9;    // the widest hills are 2^cell_bits samples wide (noise/lattice_noise.h)
  int octaves = 8;
};

// Samples ∓ this on either axis exist: at 30 m, 16 million kilometres. Farther out the ground ends as bounded
// ground does.
inline constexpr int kEndlessReach = 1 << 29;

// O(octaves) a sample, in parallel where many are read. Holds nothing but the octaves. Throws usage_error for
// a ground that is none.
std::unique_ptr<HeightSource> endless_heights(const EndlessGround&);

}  // namespace terrabench
