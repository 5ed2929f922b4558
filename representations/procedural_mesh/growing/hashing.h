// Random numbers of growing: a hash of what they are for, so that they depend on no order and on no thread.
#pragma once

#include <cstdint>

namespace terrabench::growing {

// A bijection of 64 bits in which every input bit reaches every output bit (Steele et al. 2014, SplitMix).
constexpr std::uint64_t scramble(std::uint64_t v) {
  v += 0x9E3779B97F4A7C15U;
  v = (v ^ (v >> 30)) * 0xBF58476D1CE4E5B9U;
  v = (v ^ (v >> 27)) * 0x94D049BB133111EBU;
  return v ^ (v >> 31);
}

constexpr std::uint64_t combine(std::uint64_t key, std::uint64_t number) {
  return scramble(key ^ scramble(number));
}

// In [0, 1).
constexpr double share(std::uint64_t key, std::uint64_t number) {
  return static_cast<double>(combine(key, number) >> 11) * 0x1p-53;
}

}  // namespace terrabench::growing
