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

void write_png(const std::filesystem::path&, const Image&);  // whole or not at all, as write_file
Image read_png(const std::filesystem::path&);                // any PNG, converted; throws bad_input

}  // namespace terrabench
