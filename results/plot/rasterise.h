// SVG to PNG and PDF, through librsvg's rsvg-convert.
#pragma once

#include <filesystem>
#include <string_view>

namespace terrabench {

// Drawings need few colours and become small files; in rendered landscapes few would make bands.
enum class Colours { kFew, kAll };

// Writes a picture `width` pixels wide, with at most 256 colours if few, on white. Throws environment_error
// when rsvg-convert is missing or fails; then no picture is left.
void svg_to_png(const std::filesystem::path& svg, const std::filesystem::path& png, int width,
                Colours = Colours::kFew);
// The same for an SVG text; its temporary file is removed.
void svg_text_to_png(std::string_view svg, const std::filesystem::path& png, int width,
                     Colours = Colours::kFew);

// Writes a page of the picture's own shape, `millimetres` wide, with its fonts embedded; equal pictures give
// equal bytes. Throws as above.
void svg_text_to_pdf(std::string_view svg, const std::filesystem::path& pdf, double millimetres);

}  // namespace terrabench
