// SVG to pictures and PDF, through librsvg's rsvg-convert.
#pragma once

#include <filesystem>
#include <string_view>

#include "terrain/image.h"

namespace terrabench {

// Writes a picture `width` pixels wide, on white, as write_picture() does, and returns it before that loses
// anything. Throws environment_error when rsvg-convert is missing or fails; then no picture is left.
Image write_svg(std::string_view svg, const std::filesystem::path& picture, int width);

// Writes a page of the picture's own shape, `millimetres` wide, with its fonts embedded; equal pictures give
// equal bytes. Throws as above.
void svg_text_to_pdf(std::string_view svg, const std::filesystem::path& pdf, double millimetres);

}  // namespace terrabench
