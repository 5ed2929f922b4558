// Random numbers as a function of their purpose, such as (seed, level, row): the same on every machine, in
// any order of use and for any number of threads.
#pragma once

#include <cstdint>

#include "terrain/splitmix.h"

namespace terrabench::fractal {

// The random numbers of one item: number `which` of a kind, for a seed.
class CounterRandom {
 public:
  constexpr CounterRandom(std::uint64_t seed, std::uint64_t kind, std::uint64_t which)
      : key_(scramble(scramble(scramble(seed) ^ kind) ^ which)) {}

  constexpr std::uint64_t bits(std::uint64_t counter) const { return combine(key_, counter); }
  // In [0, 1).
  constexpr double share(std::uint64_t counter) const { return unit_of(bits(counter)); }
  // In [0, n), n ≤ 2^32; the bias of at most n / 2^32 does not show in a terrain.
  constexpr std::uint64_t below(std::uint64_t n, std::uint64_t counter) const {
    return (bits(counter) >> 32) * n >> 32;
  }

 private:
  std::uint64_t key_;
};

// One kind per generator, so that two of them with one seed do not draw the same numbers.
inline constexpr std::uint64_t kMidpoints = 1, kDiamondSquare = 2, kFaults = 3, kPlanetFaults = 4, kHills = 5;

// One row of displacements: a number in [-1, 1) for each x. Short enough for vectors of 32-bit lanes, so the
// SIMD code repeats it; two key words keep rows from being shifted copies of each other.
struct RowKey {
  std::uint32_t add, flip;
};
inline constexpr std::uint32_t kSpread = 0x9E3779B1U, kMixA = 0x7FEB352DU, kMixB = 0x846CA68BU;

constexpr RowKey row_key(std::uint64_t seed, std::uint64_t kind, std::uint64_t row) {
  const std::uint64_t bits = CounterRandom(seed, kind, row).bits(0);
  return {static_cast<std::uint32_t>(bits), static_cast<std::uint32_t>(bits >> 32)};
}

constexpr float displacement(RowKey key, std::uint32_t x) {
  std::uint32_t h = x * kSpread + key.add;
  h = (h ^ (h >> 16)) * kMixA ^ key.flip;
  h = (h ^ (h >> 15)) * kMixB;
  h ^= h >> 16;
  return static_cast<float>(static_cast<std::int32_t>(h) >> 8) * 0x1p-23F;  // 24 bits: exact as float
}

}  // namespace terrabench::fractal
