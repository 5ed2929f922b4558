// Random numbers that are a function of (seed, level, vertex) alone: the same for any number of threads and
// any order of evaluation.
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>

#include "terrain/splitmix.h"

namespace terrabench::subdivision {

constexpr std::uint64_t vertex_hash(std::uint64_t seed, std::uint32_t level, std::uint32_t vertex) {
  return mixed(scramble(seed) + kGolden * ((std::uint64_t{level} << 32 | vertex) + 1));
}

// Uniform in [-1, 1), of the upper 24 bits.
constexpr float uniform_of(std::uint64_t hash) {
  return static_cast<float>(static_cast<std::int32_t>(hash >> 40) - (1 << 23)) * 0x1p-23F;
}

// Normally distributed, mean 0 and variance 1 (Box and Muller 1958).
inline float normal_of(std::uint64_t hash) {
  const double a =
      static_cast<double>((hash >> 40) + 1) * 0x1p-24;  // in (0, 1], so that the logarithm is finite
  const double b = static_cast<double>(mixed(hash) >> 40) * 0x1p-24;
  return static_cast<float>(std::sqrt(-2 * std::log(a)) * std::cos(2 * std::numbers::pi * b));
}

}  // namespace terrabench::subdivision
