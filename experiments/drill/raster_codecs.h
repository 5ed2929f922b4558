// Heights through other compressors: what the same ground takes without drills.
#pragma once

#include <cstddef>

#include "terrain/heightfield.h"

namespace terrabench::drill {

struct Encoded {
  std::size_t bytes = 0;
  double rmse = 0;  // metres, after decoding
};

// Rounded to whole metres, zstd at its strongest; no-data as -32768.
Encoded zstd_int16(const Heightfield& field);
// Whole metres in a JPEG 2000 file of GDAL's; quality in percent of the lossless size, (0, 100].
Encoded jpeg2000(const Heightfield& field, double quality);
// Floats in a GeoTIFF of GDAL's, compressed by LERC and DEFLATE, no sample off by more than `error` metres.
Encoded lerc(const Heightfield& field, double error);
// All throw environment_error when GDAL lacks the driver.

// The smallest of a codec's files whose error is at most `rmse`.
Encoded jpeg2000_at(const Heightfield& field, double rmse);
Encoded lerc_at(const Heightfield& field, double rmse);

}  // namespace terrabench::drill
