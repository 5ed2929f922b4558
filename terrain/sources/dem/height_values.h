// Conversion of a band's numbers to heights in metres: no-data, mask, scale, offset and unit. Internal to
// terrain/sources/dem.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "terrain/sources/dem/gdal_session.h"

namespace terrabench {

// The conversion of a pixel's number to a height.
struct HeightRule {
  std::optional<double> no_data;
  bool masked = false;           // the file holds a mask
  double scale = 1, offset = 0;  // to metres
};

// Throws bad_input for a scale that leaves no heights; conversions are described in `notes`. `where` names
// the file in errors.
HeightRule height_rule(GDALRasterBand& band, const std::string& where, std::vector<std::string>& notes);

// Counts of numbers that are not heights.
struct Tally {
  std::uint64_t missing = 0, impossible = 0;
};

// Rows of `width` numbers, as float (in and out are the same array then) or double. `mask` may be null; 0 in
// it means no height. Pixels without a height become kNoData and are counted.
void to_metres(float* heights, const std::uint8_t* mask, int width, int rows, const HeightRule& rule,
               Tally& tally);
void to_metres(const double* in, const std::uint8_t* mask, int width, int rows, const HeightRule& rule,
               float* out, Tally& tally);

}  // namespace terrabench
