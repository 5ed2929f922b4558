#include <png.h>

#include <array>
#include <csetjmp>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "terrain/error.h"
#include "terrain/files.h"
#include "terrain/grey_image.h"
#include "terrain/memory.h"
#include "terrain/webp.h"

namespace terrabench {
namespace {

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
