#include "terrain/webp.h"

#include <fmt/format.h>
#include <webp/decode.h>
#include <webp/encode.h>

#include <memory>

#include "terrain/error.h"
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

}  // namespace

bool is_webp(std::string_view bytes) {
  return bytes.size() >= 12 && bytes.starts_with("RIFF") && bytes.substr(8, 4) == "WEBP";
}

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

}  // namespace terrabench
