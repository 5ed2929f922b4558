// The bytes and errors of a height field in usual raster formats: the yardstick for representations that
// claim to be compact. Files are made in memory and read back; the error is that of the heights read. Holes
// are filled for the codec; they have no error, and a mask of one bit per sample, under zstd, counts as
// bytes.
#pragma once

#include <cstddef>
#include <string_view>

#include "terrain/heightfield.h"

namespace terrabench {

enum class RasterCodec {
  kZstd,             // 16-bit numbers of steps above the lowest height, row by row, zstd level 19
  kZstdDifferences,  // the same, each number minus the one to the west
  kJpeg2000,         // GDAL and OpenJPEG, codestream only, of 16-bit numbers
  kLerc,             // the one block of GDAL's GeoTIFF with LERC compression, of floats
  kLercDeflate,      // the same block through DEFLATE: LERC itself packs bits without entropy coding
  kPng,              // GDAL's 16-bit PNG of steps above the lowest height: filtered rows, DEFLATE level 9
};
std::string_view name(RasterCodec);

struct CompressedSize {
  std::size_t bytes = 0;
  double rmse = 0, largest = 0;  // errors, metres
  double setting = 0;            // the setting of the codec, as below
};

// `setting`: the step in metres for zstd and PNG, the largest error in metres for both LERCs (0: none), and
// for JPEG 2000 its quality, percent of the uncompressed size (100: no loss). Throws usage_error for settings
// out of range or so fine that 16 bits do not suffice, bad_input for fields without data, environment_error
// when GDAL lacks the format.
CompressedSize compressed_size(const Heightfield& field, RasterCodec codec, double setting);

// The smallest found by bisection whose error is at most `most` metres; the finest setting if even that
// exceeds it. Costs about 15 compressions.
CompressedSize compressed_size_at(const Heightfield& field, RasterCodec codec, double most,
                                  double CompressedSize::*error = &CompressedSize::rmse);

}  // namespace terrabench
