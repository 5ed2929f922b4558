// Synthetic mountains of any size for benchmarks: value noise, seconds for 8192².
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>

#include "terrain/heightfield.h"

namespace terrabench {

// A value in [0, 1) for each lattice point.
inline float lattice(std::uint32_t x, std::uint32_t z, std::uint32_t octave) {
  std::uint32_t h = x * 0x9E3779B1U ^ z * 0x85EBCA77U ^ octave * 0xC2B2AE3DU;
  h = (h ^ (h >> 15)) * 0x2C1B3C6DU;
  h = (h ^ (h >> 12)) * 0x297A2D39U;
  return static_cast<float>((h ^ (h >> 15)) >> 8) * 0x1p-24F;
}

inline float smooth(float t) { return t * t * (3 - 2 * t); }

// Value noise over octaves from 1024 pixels down to 2: 0 to about 3000 m, `scale` 1 gives whole metres, with
// flats and pits as in SRTM.
inline Heightfield mountains(int size, float scale = 1) {
  Heightfield field;
  field.width = field.depth = size;
  field.heights.resize(static_cast<std::size_t>(size) * size);
  for (int j = 0; j < size; ++j) {
    for (int i = 0; i < size; ++i) {
      float height = 0, amplitude = 1500;
      for (std::uint32_t octave = 0, wave = 1024; octave < 10; ++octave, wave /= 2, amplitude *= 0.5F) {
        const auto x = static_cast<std::uint32_t>(i) / wave, z = static_cast<std::uint32_t>(j) / wave;
        const float s = smooth(static_cast<float>(i % wave) / static_cast<float>(wave));
        const float t = smooth(static_cast<float>(j % wave) / static_cast<float>(wave));
        const float north = lattice(x, z, octave) * (1 - s) + lattice(x + 1, z, octave) * s;
        const float south = lattice(x, z + 1, octave) * (1 - s) + lattice(x + 1, z + 1, octave) * s;
        height += amplitude * (north * (1 - t) + south * t);
      }
      field.at(i, j) = std::round(height * scale);
    }
  }
  for (float& height : field.heights) height /= scale;
  return field;
}

}  // namespace terrabench
