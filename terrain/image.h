// 8-bit RGB pictures in memory and as PNG.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <vector>

namespace terrabench {

using Rgb = std::array<std::uint8_t, 3>;

struct Image {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgb;  // rows from top to bottom, three bytes a pixel

  Image() = default;
  Image(int width, int height, Rgb fill);
  Rgb pixel(int x, int y) const;
  void set(int x, int y, Rgb);
};

// The same picture in at most `most` colours, chosen for it: a third of the bytes as PNG, where 256 do.
// Flat areas keep their colour. O(pixels · log pixels + colours · most).
Image with_few_colours(Image image, int most = 256);

// Whole or not at all, as write_file; with a palette where 256 colours suffice and that is smaller.
void write_png(const std::filesystem::path&, const Image&);
// Any PNG, converted; what is transparent becomes white. Throws bad_input.
Image read_png(const std::filesystem::path&);

}  // namespace terrabench
