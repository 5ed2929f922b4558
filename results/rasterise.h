// SVG to PNG, through librsvg's rsvg-convert.
#pragma once

#include <filesystem>
#include <string_view>

namespace terrabench {

// A picture so many pixels wide, of at most 256 colours, on white. Throws environment_error when the program
// is missing or fails; no half-written picture is left.
void svg_to_png(const std::filesystem::path& svg, const std::filesystem::path& png, int width);
// The same of an SVG that nobody keeps.
void svg_text_to_png(std::string_view svg, const std::filesystem::path& png, int width);

}  // namespace terrabench
