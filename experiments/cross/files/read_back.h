// The heights that a file for other programs keeps, read as other programs would.
#pragma once

#include <filesystem>

#include "representations/line_grid.h"

namespace terrabench::cross {

// Of a file that export_representation() wrote along these lines: the raster's samples, the table's highest
// spans, the highest crossings of vertical lines with the polygons, the volume's surface, or what the loaded
// structure answers. The georeference is what the file states; empty for forms that state none. Throws Error
// for an extension that nothing here reads.
Heightfield read_back(const std::filesystem::path&, const LineGrid&);

}  // namespace terrabench::cross
