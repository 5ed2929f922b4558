#include "terrain/image.h"

#include <png.h>

#include <cstring>

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

void write_png(const std::filesystem::path& path, const Image& image) {
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  png.width = static_cast<png_uint_32>(image.width);
  png.height = static_cast<png_uint_32>(image.height);
  png.format = PNG_FORMAT_RGB;
  png_alloc_size_t size = 0;
  std::vector<std::byte> bytes;
  if (png_image_write_get_memory_size(png, size, 0, image.rgb.data(), 0, nullptr) != 0) {
    bytes.resize(size);
    if (png_image_write_to_memory(&png, bytes.data(), &size, 0, image.rgb.data(), 0, nullptr) != 0) {
      bytes.resize(size);
      write_file(path, bytes);
      return;
    }
  }
  throw environment_error(png.message, path.string(), "the picture cannot be encoded");
}

Image read_png(const std::filesystem::path& path) {
  constexpr std::uint64_t kLargestFile = std::uint64_t{1} << 30;
  constexpr std::uint64_t kMostPixels = std::uint64_t{1} << 28;
  const std::string bytes = read_file(path, kLargestFile);
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  const auto fail = [&](const char* what) {
    const Error error = bad_input(what, path.string(), "give a complete PNG file");
    png_image_free(&png);
    return error;
  };
  if (png_image_begin_read_from_memory(&png, bytes.data(), bytes.size()) == 0) throw fail(png.message);
  if (std::uint64_t{png.width} * png.height > kMostPixels) throw fail("the picture has too many pixels");
  png.format = PNG_FORMAT_RGB;
  Image image(static_cast<int>(png.width), static_cast<int>(png.height), {});
  if (png_image_finish_read(&png, nullptr, image.rgb.data(), 0, nullptr) == 0) throw fail(png.message);
  return image;
}

}  // namespace terrabench
