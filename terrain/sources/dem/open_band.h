// Opens a raster and chooses what holds its heights. Internal to terrain/sources/dem.
#pragma once

#include <string>
#include <vector>

#include "terrain/sources/dem/dem.h"
#include "terrain/sources/dem/gdal_session.h"

namespace terrabench {

// For messages: inline VRT is too long for them.
std::string label(const std::string& path);

// Throws bad_input with what GDAL said.
DatasetPointer open_dataset(const std::string& path, const std::string& where, const GdalMessages&);

// The band whose numbers are heights, or the three of a picture that encodes them. Throws bad_input for what
// holds no heights, and usage_error for options that do not fit; says in `notes` what was left out.
std::vector<GDALRasterBand*> choose_bands(GDALDataset&, const DemOptions&, const std::string& where,
                                          std::vector<std::string>& notes);

// Throws bad_input for a raw file that ends before its pixels do: some formats read zeros then.
void check_raw_length(GDALDataset&, int band, const std::string& where);

}  // namespace terrabench
