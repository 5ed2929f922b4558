// The position and size in metres of a raster's pixels. Internal to terrain/sources/dem.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "terrain/sources/dem/dem.h"
#include "terrain/sources/dem/gdal_session.h"

namespace terrabench {

struct Placement {
  Georeference georeference;                   // of the window as the file stores it, before any flip
  double cell_x = 1, cell_z = 1;               // metres, both > 0
  bool mirrored = false, south_first = false;  // columns run west, rows run north: both are flipped
  double plan_unit = 1;                        // metres in a unit of the plan; 1 for degrees
  std::optional<double> vertical_unit;         // the same of the vertical reference system, if there is one
};

// Which way the file orders its pixels; columns to the east and rows to the south if it does not say.
struct Directions {
  bool mirrored = false, south_first = false;
};
Directions directions_of(GDALDataset& dataset);

// Degrees become metres at the window's middle latitude; feet and other units by their definition; and where
// a map projection stretches the ground, as Web Mercator does, cells become as large as the ground under the
// middle of the window. The reference system is that of heights in metres. Throws bad_input for rotated
// grids, cells without a size and coordinates that are no plan. `where` names the file in errors; decisions
// are described in `notes`.
Placement place_raster(GDALDataset& dataset, const DemWindow& window, const std::string& where,
                       std::vector<std::string>& notes);

}  // namespace terrabench
