#include "terrain/printable.h"

#include <algorithm>

namespace terrabench {
namespace {

// The length of a character that is not printable and begins the text; 0 for others.
std::size_t unprintable(std::string_view text) {
  const auto byte = [&](std::size_t i) { return i < text.size() ? static_cast<unsigned char>(text[i]) : 0; };
  if (byte(0) < 0x20 || byte(0) == 0x7F) return 1;
  if (byte(0) == 0xC2 && byte(1) >= 0x80 && byte(1) < 0xA0) return 2;   // C1
  if (byte(0) == 0xEF && byte(1) == 0xBF && byte(2) >= 0xBE) return 3;  // U+FFFE, U+FFFF
  return 0;
}

}  // namespace

std::string printable(std::string_view text) {
  std::string out;
  out.reserve(text.size());
  while (!text.empty()) {
    const std::size_t bad = unprintable(text);
    out += bad > 0 ? ' ' : text[0];
    text.remove_prefix(std::max<std::size_t>(bad, 1));
  }
  return out;
}

}  // namespace terrabench
