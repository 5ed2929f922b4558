// Grids of numbers as text (Arc/Info and GRASS ASCII grids). GDAL reads a word among the numbers as 0.
#pragma once

#include <string>

namespace terrabench {

// Throws bad_input with line and column if the values of the grid hold a word that is no number. Reads the
// file once, in blocks. O(bytes).
void check_text_grid(const std::string& path, const std::string& where);

}  // namespace terrabench
