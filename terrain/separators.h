// Whole numbers as people read them.
#pragma once

#include <cstdint>
#include <string>

namespace terrabench {

// The digits of a whole number, which may follow a minus sign, with thousands separators: 393,216.
std::string with_separators(std::string digits);
inline std::string with_separators(std::uint64_t n) { return with_separators(std::to_string(n)); }

}  // namespace terrabench
