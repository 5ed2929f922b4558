// PNG files for tests, byte by byte: any type of pixel, and chunks that a writer of pictures would not add.
#pragma once

#include <cstdint>
#include <string>

namespace terrabench {

inline std::string big_endian(std::uint32_t v) {
  return {static_cast<char>(v >> 24), static_cast<char>(v >> 16), static_cast<char>(v >> 8),
          static_cast<char>(v)};
}

inline std::string png_chunk(const std::string& type, const std::string& data) {
  std::uint32_t crc = ~0U;
  for (const char c : type + data) {
    crc ^= static_cast<std::uint8_t>(c);
    for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1) ^ ((crc & 1) != 0 ? 0xEDB88320U : 0U);
  }
  return big_endian(static_cast<std::uint32_t>(data.size())) + type + data + big_endian(~crc);
}

// `colour` as in the header: 0 grey, 2 RGB, 3 palette, 4 grey and alpha, 6 RGBA. `rows`: the pixels' bytes,
// below 64 KiB with one byte more per row. `chunks` stand before the pixels.
inline std::string png_bytes(int width, int height, int bits, int colour, const std::string& rows,
                             const std::string& chunks = "") {
  std::string filtered;
  const std::size_t row = rows.size() / static_cast<std::size_t>(height);
  for (int y = 0; y < height; ++y) filtered += '\0' + rows.substr(y * row, row);
  std::uint32_t a = 1, b = 0;
  for (const char c : filtered) {
    a = (a + static_cast<std::uint8_t>(c)) % 65521;
    b = (b + a) % 65521;
  }
  const auto length = static_cast<std::uint16_t>(filtered.size());
  const auto little = [](std::uint16_t v) {
    return std::string{static_cast<char>(v), static_cast<char>(v >> 8)};
  };
  const std::string stored = "\x78\x01\x01" + little(length) + little(static_cast<std::uint16_t>(~length)) +
                             filtered + big_endian(b << 16 | a);
  const std::string header = big_endian(static_cast<std::uint32_t>(width)) +
                             big_endian(static_cast<std::uint32_t>(height)) + static_cast<char>(bits) +
                             static_cast<char>(colour) + std::string(3, '\0');
  return "\x89PNG\r\n\x1A\n" + png_chunk("IHDR", header) + chunks + png_chunk("IDAT", stored) +
         png_chunk("IEND", "");
}

}  // namespace terrabench
