// The random numbers of SplitMix64 (Steele, Lea & Flood 2014): the same on every machine.
#pragma once

#include <cstdint>

namespace terrabench {

inline constexpr std::uint64_t kGolden = 0x9E3779B97F4A7C15U;  // 2^64 over the golden ratio

// A bijection of 64 bits in which every input bit reaches every output bit.
constexpr std::uint64_t mixed(std::uint64_t v) {
  v = (v ^ (v >> 30)) * 0xBF58476D1CE4E5B9U;
  v = (v ^ (v >> 27)) * 0x94D049BB133111EBU;
  return v ^ (v >> 31);
}
// As mixed(), and 0 does not stay 0.
constexpr std::uint64_t scramble(std::uint64_t v) { return mixed(v + kGolden); }
constexpr std::uint64_t combine(std::uint64_t key, std::uint64_t number) {
  return scramble(key ^ scramble(number));
}
// In [0, 1), of the upper 53 bits.
constexpr double unit_of(std::uint64_t bits) { return static_cast<double>(bits >> 11) * 0x1p-53; }
constexpr double random_share(std::uint64_t key, std::uint64_t number) {
  return unit_of(combine(key, number));
}

// One number after the other.
class SplitMix {
 public:
  explicit constexpr SplitMix(std::uint64_t seed) : state_(seed) {}
  constexpr std::uint64_t next() { return mixed(state_ += kGolden); }

 private:
  std::uint64_t state_;
};

}  // namespace terrabench
