// 8-bit RGB pictures in memory, as PNG and as WebP.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string_view>
#include <vector>

namespace terrabench {

using Rgb = std::array<std::uint8_t, 3>;

struct Image {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgb;  // rows from top to bottom, three bytes per pixel

  Image() = default;
  Image(int width, int height, Rgb fill);
  Rgb pixel(int x, int y) const;
  void set(int x, int y, Rgb);
};

// A PNG file's bytes. Throws environment_error if the picture cannot be encoded.
std::vector<std::byte> png_of(const Image&);
// Writes WebP if the name ends in .webp, otherwise PNG; whole or not at all, as write_file() does.
void write_picture(const std::filesystem::path&, const Image&);
// Width and height, from the header of a PNG or WebP file with these bytes. Throws bad_input.
std::array<int, 2> picture_size(std::string_view bytes, std::string_view origin);
// Any PNG or WebP, converted to RGB; transparent pixels become white. Throws bad_input.
Image read_picture(const std::filesystem::path&);

// Shades of grey, 16 bits per pixel.
struct GreyImage {
  int width = 0, height = 0;
  std::vector<std::uint16_t> values;  // rows from top to bottom, 0 black to 65535 white
};
// Luma of BT.601, which gives a grey pixel its own value.
GreyImage grey(const Image&);
// Any PNG; transparent pixels become white. As in read_picture(), numbers are taken as they are stored: gamma
// and colour profiles, which say how bright a screen shows them, change nothing. Throws bad_input.
GreyImage read_grey_png(const std::filesystem::path&);

}  // namespace terrabench
