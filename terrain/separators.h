// Whole numbers as people read them.
#pragma once

#include <cstdint>
#include <string>

namespace terrabench {

// The digits of a whole number, which may follow a minus sign, with thousands separators: 393,216.
inline std::string with_separators(std::string digits) {
  const std::size_t sign = digits.starts_with('-') ? 1 : 0;
  for (std::size_t at = digits.size(); at > sign + 3;) digits.insert(at -= 3, 1, ',');
  return digits;
}
inline std::string with_separators(std::uint64_t n) { return with_separators(std::to_string(n)); }

}  // namespace terrabench
