#include "results/report/preview.h"

#include <fmt/format.h>
#include <webp/encode.h>

#include <algorithm>
#include <cmath>

#include "terrain/error.h"

namespace terrabench {
namespace {

constexpr int kMostRows = 16383;  // of a WebP file
constexpr float kQuality = 70;    // of 100; the axes' small numbers stay legible
constexpr int kEffort = 6;        // of 6: the smallest file of that quality

struct Picture : WebPPicture {
  Picture() {
    WebPPictureInit(this);
    use_argb = 1;
    writer = WebPMemoryWrite;
    custom_ptr = &bytes;
    WebPMemoryWriterInit(&bytes);
  }
  ~Picture() {
    WebPPictureFree(this);
    WebPMemoryWriterClear(&bytes);
  }
  Picture(const Picture&) = delete;
  Picture& operator=(const Picture&) = delete;

  WebPMemoryWriter bytes;
};

}  // namespace

std::string webp_preview(const Image& image, int width) {
  WebPConfig config;
  Picture picture;
  picture.width = image.width;
  picture.height = image.height;
  const double scale = std::min(
      {1.0, static_cast<double>(width) / image.width, static_cast<double>(kMostRows) / image.height});
  const auto scaled = [&](int side) { return std::max(1, static_cast<int>(std::lround(scale * side))); };
  bool good = WebPConfigPreset(&config, WEBP_PRESET_DRAWING, kQuality) != 0;
  config.method = kEffort;
  good = good && WebPPictureImportRGB(&picture, image.rgb.data(), 3 * image.width) != 0 &&
         (scale == 1 || WebPPictureRescale(&picture, scaled(image.width), scaled(image.height)) != 0) &&
         WebPEncode(&config, &picture) != 0;
  if (!good) {
    throw environment_error(fmt::format("libwebp failed with code {}", static_cast<int>(picture.error_code)),
                            fmt::format("a picture of {} × {} pixels", image.width, image.height),
                            "free some memory, or draw a smaller picture");
  }
  return {reinterpret_cast<const char*>(picture.bytes.mem), picture.bytes.size};
}

}  // namespace terrabench
