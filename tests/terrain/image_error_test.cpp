#include "terrain/metrics/image_error.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

#include "terrain/error.h"

namespace terrabench {
namespace {

Image noise(int width, int height, unsigned seed) {
  Image image(width, height, {0, 0, 0});
  std::mt19937 random(seed);
  for (std::uint8_t& value : image.rgb) value = static_cast<std::uint8_t>(random());
  return image;
}

TEST(Psnr, OfAConstantDifference) {
  const Image a(20, 10, {100, 100, 100});
  EXPECT_TRUE(std::isinf(psnr(a, a)));
  EXPECT_NEAR(psnr(a, Image(20, 10, {101, 101, 101})), 48.1308, 1e-4);
  EXPECT_NEAR(psnr(Image(3, 3, {0, 0, 0}), Image(3, 3, {255, 255, 255})), 0, 1e-12);
}

TEST(Ssim, OfEqualPicturesIsOne) {
  const Image a = noise(40, 30, 1);
  EXPECT_NEAR(ssim(a, a), 1, 1e-12);
}

TEST(Ssim, OfConstantPicturesIsTheLuminanceTerm) {
  const double c1 = 6.5025, expected = (2.0 * 100 * 120 + c1) / (100.0 * 100 + 120 * 120 + c1);
  EXPECT_NEAR(ssim(Image(30, 30, {100, 100, 100}), Image(30, 30, {120, 120, 120})), expected, 1e-9);
}

TEST(Ssim, OfANegativeIsNegative) {
  const Image a = noise(64, 64, 2);
  Image negative = a;
  for (std::uint8_t& value : negative.rgb) value = static_cast<std::uint8_t>(255 - value);
  EXPECT_LT(ssim(a, negative), -0.5);
  EXPECT_NEAR(ssim(a, noise(64, 64, 3)), 0, 0.1);
}

// One window of two grey levels in stripes against its mean: var_x = 2500, the other 0, no covariance.
TEST(Ssim, OfASmallPictureIsOneEvenWindow) {
  Image stripes(4, 2, {50, 50, 50});
  for (int y = 0; y < 2; ++y) {
    for (const int x : {1, 3}) stripes.set(x, y, {150, 150, 150});
  }
  const double c2 = 58.5225;
  EXPECT_NEAR(ssim(stripes, Image(4, 2, {100, 100, 100})), c2 / (2500 + c2), 1e-9);
}

// A step in one row shows in the windows that cover it, and in no other: each window reads its own rows.
TEST(Ssim, OfOneChangedRowIsThatOfTheWindowsThatCoverIt) {
  const int width = 11, height = 40, row = 25;
  const Image flat(width, height, {100, 100, 100});
  Image changed = flat;
  for (int x = 0; x < width; ++x) changed.set(x, row, {200, 200, 200});
  double expected = 0, sum = 0;
  std::array<double, 11> weights{};
  for (int k = 0; k < 11; ++k) sum += weights[k] = std::exp(-(k - 5) * (k - 5) / 4.5);
  const double c1 = 6.5025, c2 = 58.5225;
  for (int top = 0; top + 11 <= height; ++top) {
    const double weight = top <= row && row < top + 11 ? weights[row - top] / sum : 0;
    const double mean = 100 + 100 * weight, variance = 1e4 * weight * (1 - weight);
    expected += (2 * 100 * mean + c1) * c2 / ((100.0 * 100 + mean * mean + c1) * (variance + c2));
  }
  EXPECT_NEAR(ssim(flat, changed), expected / 30, 1e-9);
}

TEST(DifferingPixels, AreThoseThatDifferInAnyChannel) {
  const Image a(5, 4, {10, 20, 30});
  Image b = a;
  EXPECT_EQ(differing_pixels(a, b), 0U);
  b.set(0, 0, {11, 20, 30});
  b.set(3, 2, {10, 20, 31});
  b.set(4, 3, {10, 0, 0});
  EXPECT_EQ(differing_pixels(a, b), 3U);
}

TEST(ImageError, RefusesPicturesOfTwoSizes) {
  EXPECT_THROW(psnr(Image(3, 3, {}), Image(3, 4, {})), Error);
  EXPECT_THROW(ssim(Image(3, 3, {}), Image(4, 3, {})), Error);
  EXPECT_THROW(ssim(Image(), Image()), Error);
  EXPECT_THROW(differing_pixels(Image(3, 3, {}), Image(4, 3, {})), Error);
}

}  // namespace
}  // namespace terrabench
