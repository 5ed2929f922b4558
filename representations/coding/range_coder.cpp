#include "representations/coding/range_coder.h"

#include <algorithm>
#include <utility>

namespace terrabench {
namespace {

constexpr std::uint32_t kTop = 1U << 24;
constexpr int kQuick = 4, kSlow = 7;  // shifts: the estimates average over about 16 and 128 bits

}  // namespace

std::uint32_t BitModel::zero() const {
  constexpr std::uint32_t kLeast = 64, kMost = (1U << kBits) - kLeast;
  return std::clamp((static_cast<std::uint32_t>(quick_) + slow_) / 2, kLeast, kMost);
}

void BitModel::learn(bool bit) {
  const auto towards = [&](std::uint16_t estimate, int shift) {
    return static_cast<std::uint16_t>(bit ? estimate - (estimate >> shift)
                                          : estimate + ((0xFFFF - estimate) >> shift));
  };
  quick_ = towards(quick_, kQuick);
  slow_ = towards(slow_, kSlow);
}

void RangeEncoder::shift() {
  if (low_ < 0xFF000000U || low_ > 0xFFFFFFFFU) {
    const auto carry = static_cast<std::uint8_t>(low_ >> 32);
    for (; pending_ > 0; --pending_) {
      bytes_.push_back(static_cast<std::byte>(static_cast<std::uint8_t>(cache_ + carry)));
      cache_ = 0xFF;
    }
    cache_ = static_cast<std::uint8_t>(low_ >> 24);
  }
  ++pending_;
  low_ = (low_ & 0x00FFFFFFU) << 8;
}

void RangeEncoder::bit(BitModel& model, bool value) {
  const std::uint32_t split = (range_ >> BitModel::kBits) * model.zero();
  if (value) {
    low_ += split;
    range_ -= split;
  } else {
    range_ = split;
  }
  model.learn(value);
  while (range_ < kTop) {
    range_ <<= 8;
    shift();
  }
}

void RangeEncoder::even_bits(std::uint32_t value, int count) {
  for (int i = count - 1; i >= 0; --i) {
    range_ >>= 1;
    if ((value >> i & 1U) != 0) low_ += range_;
    while (range_ < kTop) {
      range_ <<= 8;
      shift();
    }
  }
}

std::vector<std::byte> RangeEncoder::finish() {
  for (int i = 0; i < 5; ++i) shift();
  return std::move(bytes_);
}

RangeDecoder::RangeDecoder(std::span<const std::byte> bytes, const ByteSource& source)
    : bytes_(bytes), source_(source) {
  for (int i = 0; i < 5; ++i) shift();
}

void RangeDecoder::shift() {
  if (position_ == bytes_.size()) source_.fail("the coded numbers end too early");
  code_ = code_ << 8 | std::to_integer<std::uint32_t>(bytes_[position_++]);
}

bool RangeDecoder::bit(BitModel& model) {
  const std::uint32_t split = (range_ >> BitModel::kBits) * model.zero();
  const bool value = code_ >= split;
  if (value) {
    code_ -= split;
    range_ -= split;
  } else {
    range_ = split;
  }
  model.learn(value);
  while (range_ < kTop) {
    range_ <<= 8;
    shift();
  }
  return value;
}

std::uint32_t RangeDecoder::even_bits(int count) {
  std::uint32_t value = 0;
  for (int i = 0; i < count; ++i) {
    range_ >>= 1;
    const bool bit = code_ >= range_;
    if (bit) code_ -= range_;
    value = 2 * value + static_cast<std::uint32_t>(bit);
    while (range_ < kTop) {
      range_ <<= 8;
      shift();
    }
  }
  return value;
}

}  // namespace terrabench
