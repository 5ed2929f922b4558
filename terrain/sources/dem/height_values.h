// Conversion of a file's numbers to heights in metres: no-data, mask, scale, offset, unit and encoding.
// Internal to terrain/sources/dem.
#pragma once

#include <array>
#include <cstdint>
#include <numeric>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "terrain/sources/dem/dem.h"
#include "terrain/sources/dem/gdal_session.h"
#include "terrain/sources/dem/placement.h"

namespace terrabench {

// Numbers that many files hold where there is no height, and that no metadata declare.
inline constexpr std::array<double, 3> kUsualNoData = {-32768, -32767, -9999};

// The conversion of a pixel's number to a height.
struct HeightRule {
  std::optional<double> no_data;
  // Those of kUsualNoData that count as no height, too; others are NaN.
  std::array<double, 3> undeclared{};
  bool masked = false;              // the file holds a mask
  bool signed_bytes = false;        // bytes above 127 are negative
  std::array<double, 3> weights{};  // of red, green and blue, whose sum is the number; 0: a single band
  double scale = 1, offset = 0;     // to metres

  bool encoded() const { return weights[0] != 0; }
};

// Throws bad_input for a scale that leaves no heights, usage_error for options that do not fit. Conversions
// and doubts are described in `notes`. `where` names the file in errors.
HeightRule height_rule(GDALRasterBand& band, const DemOptions& options, const Placement& placement,
                       const std::string& where, std::vector<std::string>& notes);

// The units of length that DemOptions::unit takes.
std::span<const std::string_view> height_units();

// Counts of numbers that are not heights.
struct Tally {
  std::uint64_t missing = 0;
  std::array<std::uint64_t, 3> undeclared{};  // as kUsualNoData
  std::uint64_t impossible = 0;               // NaN, or so large that it can only stand for no height
  std::uint64_t too_high = 0;                 // beyond ±1000 km, but not as large as those

  std::uint64_t holes() const {
    return missing + impossible + std::accumulate(undeclared.begin(), undeclared.end(), std::uint64_t{0});
  }
};

// Rows of `width` numbers, as float (in and out are the same array then) or double. `mask` may be null; 0 in
// it means no height. Pixels without a height become kNoData and are counted.
void to_metres(float* heights, const std::uint8_t* mask, int width, int rows, const HeightRule& rule,
               Tally& tally);
void to_metres(const double* in, const std::uint8_t* mask, int width, int rows, const HeightRule& rule,
               float* out, Tally& tally);

}  // namespace terrabench
