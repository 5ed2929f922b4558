#include "results/report/preview.h"

#include <gtest/gtest.h>
#include <webp/decode.h>

#include <algorithm>
#include <memory>

namespace terrabench {
namespace {

Image halves(int width, int height) {
  Image image(width, height, {230, 160, 20});
  for (int y = 0; y < height; ++y) {
    for (int x = width / 2; x < width; ++x) image.set(x, y, {10, 90, 170});
  }
  return image;
}

Image decoded(const std::string& bytes) {
  Image image;
  const std::unique_ptr<std::uint8_t, decltype(&WebPFree)> rgb(
      WebPDecodeRGB(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size(), &image.width,
                    &image.height),
      &WebPFree);
  if (rgb) image.rgb.assign(rgb.get(), rgb.get() + std::size_t{3} * image.width * image.height);
  return image;
}

void expect_near(Rgb a, Rgb b) {
  for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(a[k], b[k], 6);
}

TEST(Preview, KeepsColoursAndTheShapeOfThePicture) {
  for (const int width : {400, 100, 1}) {
    const Image image = halves(400, 200), small = decoded(webp_preview(image, width));
    EXPECT_EQ(small.width, width);
    EXPECT_EQ(small.height, std::max(1, width / 2));
    if (width < 4) continue;
    expect_near(small.pixel(width / 8, small.height / 2), {230, 160, 20});
    expect_near(small.pixel(width - 1 - width / 8, small.height / 2), {10, 90, 170});
  }
}

TEST(Preview, FitsTheFormatsMostRows) {
  const Image small = decoded(webp_preview(Image(8, 20000, {1, 2, 3}), 100));
  EXPECT_EQ(small.height, 16383);
  EXPECT_EQ(small.width, 7);
}

TEST(Preview, NeverEnlarges) { EXPECT_EQ(decoded(webp_preview(halves(30, 20), 1000)).width, 30); }

TEST(Preview, IsEqualForEqualPictures) {
  EXPECT_EQ(webp_preview(halves(320, 200), 100), webp_preview(halves(320, 200), 100));
}

}  // namespace
}  // namespace terrabench
