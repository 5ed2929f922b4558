// SVG to PNG, through librsvg's rsvg-convert.
#pragma once

#include <filesystem>

namespace terrabench {

// Throws environment_error when the program is missing or fails; no half-written picture is left.
void svg_to_png(const std::filesystem::path& svg, const std::filesystem::path& png, int width);

}  // namespace terrabench
