// Where a clipmap reads its heights: a field in memory, a pyramid of tiles on disk that is never loaded
// whole, or a function without bounds (endless_heights()).
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <memory>

#include "terrain/heightfield.h"
#include "terrain/sources/dem/height_pyramid.h"

namespace terrabench {

// The terrain's samples as levels: lattice sample (a, b) of level l is sample (a·2ˡ, b·2ˡ) of the terrain,
// not filtered, so that levels agree to the bit where they meet.
class HeightSource {
 public:
  virtual ~HeightSource() = default;
  // The first and last sample of the ground; outside, read() returns the nearest sample of the border. Ground
  // that is not bounded() reaches farther than any view, so the far plane and not the ground's size
  // determines the number of levels.
  virtual glm::ivec2 first() const { return glm::ivec2(0); }
  virtual glm::ivec2 last() const = 0;
  virtual bool bounded() const { return true; }
  virtual float cell_x() const = 0;  // metres
  virtual float cell_z() const = 0;
  // Lattice samples [a, a + columns) × [b, b + rows), row by row, into `out`, whose rows are `stride` apart.
  virtual void read(int level, int a, int b, int columns, int rows, float* out, int stride) = 0;
  virtual std::size_t bytes() const = 0;  // heap bytes, itself included
};

// The field must outlive it.
std::unique_ptr<HeightSource> heights_in_memory(const Heightfield&);
std::unique_ptr<HeightSource> heights_on_disk(std::unique_ptr<HeightPyramid>);

// Ground without bounds, computed where a clipmap reads it (the endless terrain of the hybrid paper, §3.2):
// fractal noise at whole samples, a pure function of seed and sample, so heights are identical on return.
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
