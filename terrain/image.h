// 8-bit RGB pictures in memory and as PNG.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
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

// The same picture in at most `most` colours chosen for it: as PNG, 256 colours take a third of the bytes.
// Flat areas keep their colour. O(pixels · log pixels + colours · most).
Image with_few_colours(Image image, int most = 256);

// A PNG file's bytes; with a palette if 256 colours suffice and that is smaller. Throws environment_error if
// the picture cannot be encoded.
std::vector<std::byte> png_of(const Image&);
// The same as a file, written whole or not at all, as by write_file().
void write_png(const std::filesystem::path&, const Image&);
// Width and height, from the file's header alone. Throws bad_input.
std::array<int, 2> png_size(const std::filesystem::path&);
// Any PNG, converted to RGB; transparent pixels become white. Throws bad_input.
Image read_png(const std::filesystem::path&);

}  // namespace terrabench
