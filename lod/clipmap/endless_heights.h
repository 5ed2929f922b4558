// Ground without bounds, computed where a clipmap reads it (the endless terrain of the hybrid paper, §3.2):
// fractal noise at whole samples, a pure function of seed and sample, so heights are identical on return.
#pragma once

#include <cstdint>
#include <memory>

#include "lod/clipmap/height_source.h"

namespace terrabench {

struct EndlessGround {
  std::uint64_t seed = 0;
  float cell = 30;      // metres between samples
  float relief = 6000;  // metres per unit of noise; heights lie within ±relief, nearly all within a third
  int cell_bits = 9;    // the widest hills are 2^cell_bits samples wide (noise/lattice_noise.h)
  int octaves = 8;
};

// Samples from -kEndlessReach to kEndlessReach exist on either axis (16 million kilometres at 30 m); beyond,
// the ground ends like bounded ground.
inline constexpr int kEndlessReach = 1 << 29;

// O(octaves) per sample, in parallel where many are read; stores only the octaves. Throws usage_error unless
// cell is positive and finite and relief finite.
std::unique_ptr<HeightSource> endless_heights(const EndlessGround&);

}  // namespace terrabench
