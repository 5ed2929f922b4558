#include "terrain/image.h"

#include <fmt/format.h>
#include <png.h>
#include <webp/decode.h>
#include <webp/encode.h>

#include <array>
#include <csetjmp>
#include <cstdint>
#include <cstring>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "terrain/error.h"
#include "terrain/files.h"
#include "terrain/memory.h"

namespace terrabench {
namespace {

// Of 100. At this quality, libwebp's own, renderings and maps look the same at a tenth to a third of a PNG's
// bytes. Plots take about as many bytes with losses as without: the factor keeps them exact.
constexpr float kQuality = 75;
constexpr double kWorthLosses = 1.5;

std::vector<std::byte> encoded(const Image& image, bool lossless) {
  WebPConfig config;
  WebPPicture picture;
  const bool compatible = WebPConfigInit(&config) != 0 && WebPPictureInit(&picture) != 0;
  if (!compatible) throw environment_error("is of another version", "libwebp", "install Debian's libwebp7");
  config.lossless = lossless ? 1 : 0;
  if (!lossless) config.quality = kQuality;
  config.use_sharp_yuv = 1;  // colour has half the resolution: this keeps thin coloured lines
  WebPMemoryWriter writer;
  WebPMemoryWriterInit(&writer);
  const std::unique_ptr<WebPMemoryWriter, decltype(&WebPMemoryWriterClear)> bytes(&writer,
                                                                                  WebPMemoryWriterClear);
  const std::unique_ptr<WebPPicture, decltype(&WebPPictureFree)> pixels(&picture, WebPPictureFree);
  picture.use_argb = 1;
  picture.width = image.width;
  picture.height = image.height;
  picture.writer = WebPMemoryWrite;
  picture.custom_ptr = &writer;
  if (WebPPictureImportRGB(&picture, image.rgb.data(), 3 * image.width) == 0 ||
      WebPEncode(&config, &picture) == 0) {
    throw environment_error(fmt::format("libwebp stops with error {}", static_cast<int>(picture.error_code)),
                            "WebP", "the picture cannot be encoded");
  }
  const auto* const first = reinterpret_cast<const std::byte*>(writer.mem);
  return {first, first + writer.size};
}

const std::uint8_t* data(std::string_view bytes) {
  return reinterpret_cast<const std::uint8_t*>(bytes.data());
}

bool is_webp(std::string_view bytes) {
  return bytes.size() >= 12 && bytes.starts_with("RIFF") && bytes.substr(8, 4) == "WEBP";
}

// Without losses, or with them if that saves a third of the bytes: drawings keep their sharp lines and exact
// colours, and renderings become small. Equal pictures give equal bytes. Throws environment_error for more
// than 16,383 pixels a side.
std::vector<std::byte> webp_of(const Image& image) {
  std::vector<std::byte> exact = encoded(image, true), lossy = encoded(image, false);
  return kWorthLosses * static_cast<double>(lossy.size()) < static_cast<double>(exact.size()) ? lossy : exact;
}

std::array<int, 2> webp_size(std::string_view bytes, std::string_view origin) {
  std::array<int, 2> size{};
  if (WebPGetInfo(data(bytes), bytes.size(), &size[0], &size[1]) == 0)
    throw bad_input("is no WebP picture", origin, "give a complete WebP file");
  return size;
}

// Animations are refused.
Image decode_webp(std::string_view bytes, std::string_view origin) {
  const auto [width, height] = webp_size(bytes, origin);
  const std::size_t count = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  require_memory(7 * count, origin, "give a smaller picture");
  std::vector<std::uint8_t> rgba(4 * count);
  if (WebPDecodeRGBAInto(data(bytes), bytes.size(), rgba.data(), rgba.size(), 4 * width) == nullptr)
    throw bad_input("is damaged or animated", origin, "give a complete WebP file");
  Image image(width, height, {});
  for (std::size_t i = 0; i < count; ++i) {
    const unsigned alpha = rgba[4 * i + 3];
    for (std::size_t c = 0; c < 3; ++c) {
      const unsigned over_white = rgba[4 * i + c] * alpha + 255 * (255 - alpha);
      image.rgb[3 * i + c] = static_cast<std::uint8_t>((over_white + 127) / 255);
    }
  }
  return image;
}

constexpr std::uint64_t kLargestFile = std::uint64_t{1} << 30;
constexpr std::uint64_t kMostPixels = std::uint64_t{1} << 28;

// Decodes one PNG. libpng's own simplified interface would take 16 bits for linear light and obey gAMA; this
// one converts nothing but the number of bits.
class Decoder {
 public:
  Decoder(const std::filesystem::path& path, std::string bytes, int bits)
      : path_(path.string()), bytes_(std::move(bytes)) {
    png_ = png_create_read_struct(PNG_LIBPNG_VER_STRING, this, fail, ignore);
    info_ = png_ == nullptr ? nullptr : png_create_info_struct(png_);
    if (info_ == nullptr) {
      png_destroy_read_struct(&png_, &info_, nullptr);
      throw environment_error("not enough memory to read it", path_, "give a smaller picture");
    }
    try {
      if (!read_header(bits)) throw bad_input(message_, path_, "give a complete PNG file");
      if (std::uint64_t(width) * std::uint64_t(height) > kMostPixels)
        throw bad_input("the picture has too many pixels", path_, "give a smaller picture");
      // What it becomes has at most 3 bytes per pixel.
      require_memory(row_bytes_ * height + std::uint64_t{3} * width * height, path_,
                     "give a smaller picture");
      numbers_.resize((row_bytes_ * height + 1) / 2);
      rows_.resize(height);
      for (int y = 0; y < height; ++y)
        rows_[y] = reinterpret_cast<png_bytep>(numbers_.data()) + row_bytes_ * y;
      if (!read_pixels()) throw bad_input(message_, path_, "give a complete PNG file");
    } catch (...) {
      png_destroy_read_struct(&png_, &info_, nullptr);
      throw;
    }
  }
  ~Decoder() { png_destroy_read_struct(&png_, &info_, nullptr); }
  Decoder(const Decoder&) = delete;
  Decoder& operator=(const Decoder&) = delete;

  int width = 0, height = 0;
  int channels = 0;  // grey or RGB, then alpha if even
  // The decoded numbers, of as many bits as T.
  template <class T>
  const T* pixels() const {
    return reinterpret_cast<const T*>(numbers_.data());
  }

 private:
  static Decoder& of(png_structp png) { return *static_cast<Decoder*>(png_get_error_ptr(png)); }
  [[noreturn]] static void fail(png_structp png, const char* message) {
    of(png).message_ = message;
    png_longjmp(png, 1);
  }
  static void ignore(png_structp, const char*) {}
  static void take(png_structp png, png_bytep out, std::size_t count) {
    auto& from = *static_cast<Decoder*>(png_get_io_ptr(png));
    if (count > from.bytes_.size() - from.position_) png_error(png, "the file ends too early");
    std::memcpy(out, from.bytes_.data() + from.position_, count);
    from.position_ += count;
  }

  // In the two functions that libpng may leave by longjmp(), no local variable has a destructor.
  bool read_header(int bits) {
    if (setjmp(png_jmpbuf(png_)) != 0) return false;
    png_set_read_fn(png_, this, take);
    png_set_user_limits(png_, 0x7FFFFFFF, 0x7FFFFFFF);
    png_read_info(png_, info_);
    png_set_expand(png_);  // palettes, fewer than 8 bits, one transparent colour
    if (bits == 16) {
      png_set_expand_16(png_);
      png_set_swap(png_);
    } else {
      png_set_scale_16(png_);
    }
    png_set_interlace_handling(png_);
    png_read_update_info(png_, info_);
    width = static_cast<int>(png_get_image_width(png_, info_));
    height = static_cast<int>(png_get_image_height(png_, info_));
    channels = png_get_channels(png_, info_);
    row_bytes_ = png_get_rowbytes(png_, info_);
    return true;
  }
  bool read_pixels() {
    if (setjmp(png_jmpbuf(png_)) != 0) return false;
    png_read_image(png_, rows_.data());
    png_read_end(png_, nullptr);
    return true;
  }

  std::string path_, bytes_, message_;
  std::size_t position_ = 0, row_bytes_ = 0;
  png_structp png_ = nullptr;
  png_infop info_ = nullptr;
  std::vector<std::uint16_t> numbers_;
  std::vector<png_bytep> rows_;  // into numbers_
};

// The colour of pixel i over white.
template <class T>
std::array<std::uint32_t, 3> over_white(const T* pixels, std::size_t i, int channels) {
  constexpr std::uint32_t kWhite = std::numeric_limits<T>::max();
  const T* const p = pixels + i * channels;
  const bool has_alpha = channels % 2 == 0, coloured = channels >= 3;
  const std::uint64_t alpha = has_alpha ? p[channels - 1] : kWhite;
  std::array<std::uint32_t, 3> colour{};
  for (int c = 0; c < 3; ++c) {
    const std::uint64_t value = p[coloured ? c : 0];
    colour[c] = static_cast<std::uint32_t>((value * alpha + kWhite * (kWhite - alpha) + kWhite / 2) / kWhite);
  }
  return colour;
}

std::uint16_t luma(const std::array<std::uint32_t, 3>& c) {
  return static_cast<std::uint16_t>((299 * c[0] + 587 * c[1] + 114 * c[2] + 500) / 1000);
}

}  // namespace

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

Image read_picture(const std::filesystem::path& path) {
  std::string bytes = read_file(path, kLargestFile);
  if (is_webp(bytes)) return decode_webp(bytes, path.string());
  const Decoder png(path, std::move(bytes), 8);
  Image image(png.width, png.height, {255, 255, 255});
  for (std::size_t i = 0; i < image.rgb.size() / 3; ++i) {
    const auto colour = over_white(png.pixels<std::uint8_t>(), i, png.channels);
    for (int c = 0; c < 3; ++c) image.rgb[3 * i + c] = static_cast<std::uint8_t>(colour[c]);
  }
  return image;
}

GreyImage read_grey_png(const std::filesystem::path& path) {
  const Decoder png(path, read_file(path, kLargestFile), 16);
  GreyImage image{png.width, png.height, {}};
  image.values.resize(static_cast<std::size_t>(png.width) * static_cast<std::size_t>(png.height));
  for (std::size_t i = 0; i < image.values.size(); ++i) {
    image.values[i] = luma(over_white(png.pixels<std::uint16_t>(), i, png.channels));
  }
  return image;
}

GreyImage grey(const Image& picture) {
  GreyImage image{picture.width, picture.height, {}};
  image.values.resize(picture.rgb.size() / 3);
  for (std::size_t i = 0; i < image.values.size(); ++i) {
    const std::uint8_t* const c = picture.rgb.data() + 3 * i;
    image.values[i] = luma({257U * c[0], 257U * c[1], 257U * c[2]});
  }
  return image;
}

}  // namespace terrabench
