// Gradient noise and fractals in scalar code, one point at a time, to compare the SIMD evaluation with.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>

#include "terrain/sources/noise/code.h"

namespace terrabench::noise::reference {

inline float fade(float t) { return t * t * t * ((t * 6.0F - 15.0F) * t + 10.0F); }

struct Axis {
  std::uint32_t cell;
  std::array<float, 2> distance, weight;
};

inline Axis split(float p) {
  if (!(std::abs(p) < kLatticeLimit)) p = 0;
  const float floor = std::floor(p), f = p - floor;
  return {
      static_cast<std::uint32_t>(static_cast<std::int32_t>(floor)), {f, f - 1.0F}, {1.0F - fade(f), fade(f)}};
}

inline std::uint32_t hash(std::uint32_t x, std::uint32_t y, std::uint32_t z, std::uint32_t seed) {
  std::uint32_t h = (x * kLatticeX) ^ (z * kLatticeZ) ^ seed;
  h = (h ^ (h >> 16)) * kMixXz;
  h ^= y * kLatticeY;
  return (h ^ (h >> 15)) * kMixY;
}

// The three components of a lattice point's gradient, each -1, 0 or 1.
inline std::array<float, 3> direction(std::uint32_t h) {
  const std::array<float, 3> sign = {h >> 31 & 1 ? -1.0F : 1.0F, h >> 30 & 1 ? -1.0F : 1.0F,
                                     h >> 29 & 1 ? -1.0F : 1.0F};
  const auto third = static_cast<std::int32_t>(h & 0x1FFFFFFFU);
  const int zero = third < kThird ? 0 : third > 2 * kThird ? 2 : 1;
  return {zero == 0 ? 0.0F : sign[0], zero == 1 ? 0.0F : sign[1], zero == 2 ? 0.0F : sign[2]};
}

inline float gradient_noise(const Axis& x, const Axis& y, const Axis& z, std::uint32_t seed) {
  std::array<float, 2> n{};
  for (std::uint32_t k = 0; k < 2; ++k) {
    std::array<float, 4> a{}, b{};
    for (std::uint32_t c = 0; c < 4; ++c) {
      const std::uint32_t i = c % 2, j = c / 2;
      const auto g = direction(hash(x.cell + i, y.cell + k, z.cell + j, seed));
      const float w = x.weight[i] * z.weight[j];
      a[c] = g[0] * (w * x.distance[i]) + g[2] * (w * z.distance[j]);
      b[c] = g[1] * w;
    }
    n[k] = ((a[0] + a[1]) + (a[2] + a[3])) + ((b[0] + b[1]) + (b[2] + b[3])) * y.distance[k];
  }
  return (n[0] + y.weight[1] * (n[1] - n[0])) * kNormalise;
}

inline float gradient_noise(float px, float py, float pz, std::uint32_t seed) {
  return gradient_noise(split(px), split(py), split(pz), seed);
}

}  // namespace terrabench::noise::reference
