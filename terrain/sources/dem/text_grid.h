// Grids of numbers as text (Arc/Info and GRASS ASCII grids). GDAL reads a word among the numbers as 0, reads
// whole numbers as integers, which cannot hold "nan", and takes a word at the beginning for the header's.
#pragma once

namespace terrabench {

// Makes GDAL read nan, null and na in text grids as no height, and refuse them with any other word among
// their values, saying its line and column. This holds wherever GDAL opens one, also as a source of a .vrt.
// Opening a grid then reads it once more, O(bytes); one with null, na or a word as its first value is held in
// memory while it is open. Called once by register_gdal().
void guard_text_grids();

}  // namespace terrabench
