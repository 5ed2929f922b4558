// A representation as an OpenVDB file, for programs that show or simulate volumes. Voxels are written on
// their own lattice, everything else is sampled on columns_around() its lines.
//
//   grid `density`   fog volume of floats: the share of the cell's height that is solid on the vertical line
//                    through its middle. 1 inside, 0 and inactive in air, between them where a surface
//                    passes. A column whose highest cell is solid from below up to its surface keeps that
//                    height.
//   grid `material`  integers, in cells whose largest part is not bedrock (1): the number of that material.
//                    Left out when all is bedrock.
//   metadata         `units`; `columns` along x and z; where they are known, `georeference` (GDAL's six
//                    numbers) and `crs` (WKT) of a raster with a pixel around each column.
//
// Index (x, y, z) is column i, level, column j; the grid's transform gives metres: x east, y up, z south.
#pragma once

#include <filesystem>

#include "representations/line_grid.h"

namespace terrabench {

// Memory: 2 KiB per 8³ cells at a surface. Written whole or not at all. O(columns · levels / 8 + spans),
// parallel; the same grids for any number of threads (the file holds a random identifier of its own). Throws
// environment_error, also when the volume does not fit the memory.
void write_fog(const std::filesystem::path&, const Representation&, const LineGrid&, Progress&);

// The height of the surface above each column, as the file keeps it, and the georeference. For files that
// write_fog() wrote: throws bad_input for others, but what OpenVDB makes of a damaged file is its own affair.
Heightfield read_fog_heights(const std::filesystem::path&);

}  // namespace terrabench
