// Grids of numbers as text (Arc/Info and GRASS ASCII grids). GDAL reads a word among the numbers as 0.
#pragma once

namespace terrabench {

// Makes GDAL refuse text grids with a word among their values, and say its line and column. This holds
// wherever GDAL opens one, also as a source of a .vrt. Opening a grid then reads it once more, O(bytes).
// Called once by register_gdal().
void guard_text_grids();

}  // namespace terrabench
