// The position and size in metres of a raster's pixels. Internal to terrain/sources/dem.
#pragma once

#include <string>
#include <vector>

#include "terrain/sources/dem/dem.h"
#include "terrain/sources/dem/gdal_session.h"

namespace terrabench {

struct Placement {
  Georeference georeference;                   // of the window as the file stores it, before any flip
  double cell_x = 1, cell_z = 1;               // metres, both > 0
  bool mirrored = false, south_first = false;  // columns run west, rows run north: both are flipped
};

// Degrees become metres at the window's middle latitude; feet and other units by their definition. Throws
// bad_input for rotated grids and cells without a size. `where` names the file in errors; decisions are
// described in `notes`.
Placement place_raster(GDALDataset& dataset, const DemWindow& window, const std::string& where,
                       std::vector<std::string>& notes);

}  // namespace terrabench
