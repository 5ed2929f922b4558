// Random numbers that are a function of (seed, level, vertex) alone: the same for any number of threads and
// any order of evaluation.
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>

namespace terrabench::subdivision {

// The finaliser of SplitMix64 (Steele, Lea and Flood 2014): a bijection of 64 bits that mixes all of them.
constexpr std::uint64_t mixed(std::uint64_t x) {
  x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9U;
  x = (x ^ (x >> 27)) * 0x94D049BB133111EBU;
  return x ^ (x >> 31);
}

constexpr std::uint64_t vertex_hash(std::uint64_t seed, std::uint32_t level, std::uint32_t vertex) {
  constexpr std::uint64_t kGolden = 0x9E3779B97F4A7C15U;
  return mixed(mixed(seed + kGolden) + kGolden * ((std::uint64_t{level} << 32 | vertex) + 1));
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
