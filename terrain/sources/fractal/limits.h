// Range checks of the generators' options, with one form of error.
#pragma once

#include <cstdint>
#include <string_view>

namespace terrabench::fractal {

inline constexpr int kLargestSide = 32769;     // samples; 2^15 + 1
inline constexpr float kLargestMetres = 1e9F;  // heights and lengths: sums stay far from the end of float

// All throw usage_error. `where` names the generator, `what` the option.
void check_side(int samples, std::string_view what, std::string_view where);
void check_between(double value, double low, double high, std::string_view what, std::string_view where);
// Throws environment_error when that many samples would not fit the memory.
void check_memory(std::int64_t width, std::int64_t depth, std::string_view where);

// The range of random displacements after `level` reductions, each to 2^-hurst.
float level_range(float amplitude, float hurst, int level);

}  // namespace terrabench::fractal
