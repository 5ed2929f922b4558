// Low-discrepancy samples: the first two dimensions of Sobol's sequence, shuffled and scrambled anew for
// every pair of dimensions by hashed Owen scrambling (Burley 2020, §3 to §5). Points depend on the pixel, the
// sample and the seed alone, so pictures are the same for every order of work. O(1) per pair.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>

namespace terrabench {
namespace sampling {

// The second Sobol matrix applied to each byte of an index.
constexpr std::array<std::array<std::uint32_t, 256>, 4> sobol_table() {
  std::array<std::array<std::uint32_t, 256>, 4> table{};
  std::uint32_t column = 1U << 31;
  for (auto& bytes : table) {
    for (unsigned bit = 0; bit < 8; ++bit, column ^= column >> 1) {
      for (unsigned value = 0; value < 256; ++value) {
        if ((value >> bit & 1U) != 0) bytes[value] ^= column;
      }
    }
  }
  return table;
}
inline constexpr auto kSobol = sobol_table();

constexpr std::uint32_t reverse_bits(std::uint32_t x) {
  x = (x >> 1 & 0x55555555U) | (x & 0x55555555U) << 1;
  x = (x >> 2 & 0x33333333U) | (x & 0x33333333U) << 2;
  x = (x >> 4 & 0x0F0F0F0FU) | (x & 0x0F0F0F0FU) << 4;
  return __builtin_bswap32(x);
}

// An integer hash without collisions (Wellons 2018, "lowbias32").
constexpr std::uint32_t hash(std::uint32_t x) {
  x = (x ^ x >> 16) * 0x7FEB352DU;
  x = (x ^ x >> 15) * 0x846CA68BU;
  return x ^ x >> 16;
}

// Each bit is flipped depending on the bits above it: an Owen scramble (Laine & Karras 2011, with the
// constants of Vegdahl 2021).
constexpr std::uint32_t scramble(std::uint32_t x, std::uint32_t seed) {
  x = reverse_bits(x);
  x ^= x * 0x3D20ADEAU;
  x += seed;
  x *= seed >> 16 | 1U;
  x ^= x * 0x05526C56U;
  x ^= x * 0x53A22864U;
  return reverse_bits(x);
}

}  // namespace sampling

class SampleSequence {
 public:
  SampleSequence(std::uint32_t pixel, std::uint32_t sample, std::uint32_t seed)
      : stream_(sampling::hash(pixel ^ sampling::hash(seed))), sample_(sample) {}

  // The sample's next two coordinates, in [0, 1).
  glm::vec2 next() {
    using namespace sampling;
    const std::uint32_t seed = hash(stream_ + pair_++ * 0x9E3779B9U);
    const std::uint32_t at = scramble(sample_, seed);
    const std::uint32_t y =
        kSobol[0][at & 255U] ^ kSobol[1][at >> 8 & 255U] ^ kSobol[2][at >> 16 & 255U] ^ kSobol[3][at >> 24];
    return {fraction(scramble(reverse_bits(at), hash(seed ^ 0x68BC21EBU))),
            fraction(scramble(y, hash(seed ^ 0x02E5BE93U)))};
  }

 private:
  static float fraction(std::uint32_t x) { return static_cast<float>(x >> 8) * 0x1p-24F; }

  std::uint32_t stream_, sample_, pair_ = 0;
};

}  // namespace terrabench
