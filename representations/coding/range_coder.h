// Adaptive binary range coder: carry-propagating as in LZMA, each bit's probability the mean of a fast and a
// slow estimate, which suits small alphabets whose statistics drift along a channel. About 10 ns per bit.
// Integers are coded as a class (the number of binary digits) and digits, the first two of which adapt too.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstdlib>
#include <span>
#include <vector>

#include "terrain/files.h"

namespace terrabench {

// The probability that a bit is 0, learnt from the bits before.
class BitModel {
 public:
  static constexpr int kBits = 16;
  std::uint32_t zero() const;  // of 2^16, never certain
  void learn(bool bit);

 private:
  std::uint16_t quick_ = 1U << (kBits - 1), slow_ = 1U << (kBits - 1);
};

class RangeEncoder {
 public:
  void bit(BitModel& model, bool value);
  void even_bits(std::uint32_t value, int count);  // equiprobable bits, highest first; count ≤ 32
  // Ends the stream. Call once, last.
  std::vector<std::byte> finish();

 private:
  void shift();

  std::uint64_t low_ = 0;
  std::uint32_t range_ = 0xFFFFFFFF;
  std::uint64_t pending_ = 1;  // bytes that a carry may still change
  std::uint8_t cache_ = 0;
  std::vector<std::byte> bytes_;
};

// Reads what RangeEncoder wrote. Any bytes decode to something; past the end, ByteSource::fail() is thrown.
class RangeDecoder {
 public:
  // `source` only reports errors; `bytes` must stay alive.
  RangeDecoder(std::span<const std::byte> bytes, const ByteSource& source);
  bool bit(BitModel& model);
  std::uint32_t even_bits(int count);
  // Whether all bytes were read, as the encoder wrote for the same symbols.
  bool at_end() const { return position_ == bytes_.size(); }

 private:
  void shift();

  std::span<const std::byte> bytes_;
  const ByteSource& source_;
  std::size_t position_ = 0;
  std::uint32_t range_ = 0xFFFFFFFF, code_ = 0;
};

// One function for both directions: an encoder writes its argument and returns it, a decoder ignores the
// argument and returns what it reads.
inline bool code_bit(RangeEncoder& coder, BitModel& model, bool value) {
  coder.bit(model, value);
  return value;
}
inline bool code_bit(RangeDecoder& coder, BitModel& model, bool) { return coder.bit(model); }
inline std::uint32_t code_even_bits(RangeEncoder& coder, std::uint32_t value, int count) {
  coder.even_bits(value, count);
  return value;
}
inline std::uint32_t code_even_bits(RangeDecoder& coder, std::uint32_t, int count) {
  return coder.even_bits(count);
}

// Symbols of `Bits` binary digits, the digits before being the context of each.
template <int Bits>
class SymbolModel {
 public:
  template <class Coder>
  std::uint32_t code(Coder& coder, std::uint32_t value) {
    std::uint32_t node = 1;
    for (int i = Bits - 1; i >= 0; --i) {
      const bool digit = code_bit(coder, models_[node], (value >> i & 1U) != 0);
      node = 2 * node + static_cast<std::uint32_t>(digit);
    }
    return node - (std::uint32_t{1} << Bits);
  }

 private:
  std::array<BitModel, std::size_t{1} << Bits> models_;
};

// Signed integers below 2^31 in magnitude; small ones take few bits.
class NumberModel {
 public:
  // Binary digits of the magnitude: a context for a number of similar magnitude.
  static int size(std::int32_t value) { return std::bit_width(static_cast<std::uint32_t>(std::abs(value))); }

  template <class Coder>
  std::int32_t code(Coder& coder, std::int32_t value) {
    const auto digits = static_cast<int>(size_.code(coder, static_cast<std::uint32_t>(size(value))));
    if (digits == 0) return 0;
    const bool negative = code_bit(coder, sign_[digits], value < 0);
    // Below the leading digit: two that adapt, and the rest.
    const auto magnitude = static_cast<std::uint32_t>(std::abs(value));
    const int adaptive = std::min(digits - 1, 2), even = digits - 1 - adaptive;
    std::uint32_t node = 1;
    for (int i = 0; i < adaptive; ++i) {
      const bool digit = code_bit(coder, digits_[digits][node], (magnitude >> (digits - 2 - i) & 1U) != 0);
      node = 2 * node + static_cast<std::uint32_t>(digit);
    }
    const std::uint32_t rest = code_even_bits(coder, magnitude & ((1U << even) - 1), even);
    const auto coded = static_cast<std::int32_t>(node << even | rest);
    return negative ? -coded : coded;
  }

 private:
  static constexpr int kSizes = 32;
  SymbolModel<5> size_;
  BitModel sign_[kSizes], digits_[kSizes][4];
};

}  // namespace terrabench
