#include "terrain/image.h"

#include <png.h>

#include <cstring>

#include "terrain/error.h"
#include "terrain/files.h"
#include "terrain/webp.h"

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

std::vector<std::byte> png_of(const Image& image) {
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  png.width = static_cast<png_uint_32>(image.width);
  png.height = static_cast<png_uint_32>(image.height);
  png.format = PNG_FORMAT_RGB;
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(png);
  std::vector<std::byte> bytes(size);
  if (png_image_write_to_memory(&png, bytes.data(), &size, 0, image.rgb.data(), 0, nullptr) == 0)
    throw environment_error(png.message, "PNG", "the picture cannot be encoded");
  bytes.resize(size);
  return bytes;
}

void write_picture(const std::filesystem::path& path, const Image& image) {
  write_file(path, path.extension() == ".webp" ? webp_of(image) : png_of(image));
}

std::array<int, 2> picture_size(std::string_view bytes, std::string_view origin) {
  if (is_webp(bytes)) return webp_size(bytes, origin);
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  const bool good = png_image_begin_read_from_memory(&png, bytes.data(), bytes.size()) != 0;
  png_image_free(&png);
  if (!good) throw bad_input(png.message, origin, "give a complete PNG file");
  return {static_cast<int>(png.width), static_cast<int>(png.height)};
}

}  // namespace terrabench
