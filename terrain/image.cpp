#include "terrain/image.h"

#include <png.h>

#include <cstring>
#include <unordered_map>

#include "terrain/error.h"
#include "terrain/files.h"

namespace terrabench {

Image::Image(int width, int height, Rgb fill)
    : width(width),
      height(height),
      rgb(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * 3) {
  for (std::size_t i = 0; i < rgb.size(); ++i) rgb[i] = fill[i % 3];
}

Rgb Image::pixel(int x, int y) const {
  const std::uint8_t* const at = rgb.data() + (static_cast<std::size_t>(y) * width + x) * 3;
  return {at[0], at[1], at[2]};
}

void Image::set(int x, int y, Rgb color) {
  std::memcpy(rgb.data() + (static_cast<std::size_t>(y) * width + x) * 3, color.data(), 3);
}

namespace {

// An image's colours and, for each pixel, the number of its own; no colours when 256 do not suffice.
struct Palette {
  std::vector<std::uint8_t> colours, pixels;
};

Palette palette_of(const Image& image) {
  const auto pixel = [&](std::size_t i) {
    const std::uint8_t* const at = &image.rgb[3 * i];
    return static_cast<std::uint32_t>(at[0]) << 16 | static_cast<std::uint32_t>(at[1]) << 8 | at[2];
  };
  std::unordered_map<std::uint32_t, std::uint8_t> numbers;
  Palette palette;
  const std::size_t pixels = image.rgb.size() / 3;
  palette.pixels.resize(pixels);
  for (std::size_t i = 0; i < pixels; ++i) {
    if (i > 0 && pixel(i) == pixel(i - 1)) {
      palette.pixels[i] = palette.pixels[i - 1];
      continue;
    }
    const auto [at, added] = numbers.try_emplace(pixel(i), static_cast<std::uint8_t>(numbers.size()));
    if (numbers.size() > 256) return {};
    if (added) palette.colours.insert(palette.colours.end(), &image.rgb[3 * i], &image.rgb[3 * i] + 3);
    palette.pixels[i] = at->second;
  }
  return palette;
}

// Empty, with the reason in `png`, when libpng cannot encode the picture.
std::vector<std::byte> encoded(png_image& png, const void* pixels, const void* colours) {
  png_alloc_size_t size = 0;
  std::vector<std::byte> bytes;
  if (png_image_write_get_memory_size(png, size, 0, pixels, 0, colours) == 0) return {};
  bytes.resize(size);
  if (png_image_write_to_memory(&png, bytes.data(), &size, 0, pixels, 0, colours) == 0) return {};
  bytes.resize(size);
  return bytes;
}

}  // namespace

std::vector<std::byte> png_of(const Image& image) {
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  png.width = static_cast<png_uint_32>(image.width);
  png.height = static_cast<png_uint_32>(image.height);
  png.format = PNG_FORMAT_RGB;
  std::vector<std::byte> bytes = encoded(png, image.rgb.data(), nullptr);
  if (bytes.empty()) throw environment_error(png.message, "PNG", "the picture cannot be encoded");
  const Palette palette = palette_of(image);
  if (!palette.colours.empty()) {
    png.format = PNG_FORMAT_RGB_COLORMAP;
    png.colormap_entries = static_cast<png_uint_32>(palette.colours.size() / 3);
    std::vector<std::byte> shorter = encoded(png, palette.pixels.data(), palette.colours.data());
    if (!shorter.empty() && shorter.size() < bytes.size()) bytes = std::move(shorter);
  }
  return bytes;
}

void write_png(const std::filesystem::path& path, const Image& image) { write_file(path, png_of(image)); }

std::array<int, 2> png_size(const std::filesystem::path& path) {
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  const bool good = png_image_begin_read_from_file(&png, path.c_str()) != 0;
  png_image_free(&png);
  if (!good) throw bad_input(png.message, path.string(), "give a complete PNG file");
  return {static_cast<int>(png.width), static_cast<int>(png.height)};
}

}  // namespace terrabench
