#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "lod/meters/screen_error.h"

namespace terrabench {
namespace {

TEST(Distribution, IsEmptyAtFirst) {
  const Distribution none;
  EXPECT_EQ(none.samples(), 0U);
  EXPECT_EQ(none.quantile(0.99), 0);
  EXPECT_EQ(none.mean(), 0);
}

TEST(Distribution, QuantilesHoldAndAreCloseToTheExactOnes) {
  std::mt19937 random(7);
  std::vector<float> pixels(20000);
  for (float& p : pixels) p = std::exp2(static_cast<float>(random() % 4096) / 256 - 12);
  Distribution all;
  const auto half = static_cast<std::ptrdiff_t>(pixels.size() / 2);
  all.add({pixels.begin(), pixels.begin() + half});
  all.add({pixels.begin() + half, pixels.end()});
  std::sort(pixels.begin(), pixels.end());
  for (const double share : {0.0, 0.1, 0.5, 0.99, 0.9999, 1.0}) {
    const double rank = std::max(1.0, std::ceil(share * static_cast<double>(pixels.size())));
    const auto exact = static_cast<double>(pixels[static_cast<std::size_t>(rank) - 1]);
    EXPECT_GE(all.quantile(share), exact) << share;
    EXPECT_LE(all.quantile(share), exact * (1 + 1.0 / 256)) << share;
  }
  EXPECT_EQ(all.quantile(1), static_cast<double>(pixels.back()));
  EXPECT_EQ(all.largest(), static_cast<double>(pixels.back()));
}

TEST(Distribution, RootMeanSquareIsThatOfAllSamplesTogether) {
  Distribution all;
  EXPECT_EQ(all.rms(), 0);
  all.add(std::vector<float>{3.0F, 0.0F});
  all.add(std::vector<float>{4.0F, 5.0F});
  EXPECT_DOUBLE_EQ(all.rms(), std::sqrt((9.0 + 16 + 25) / 4));
}

TEST(Distribution, ZerosAreZero) {
  Distribution flat;
  flat.add(std::vector<float>(99, 0.0F));
  flat.add(std::vector<float>{5.0F});
  EXPECT_EQ(flat.quantile(0.99), 0);
  EXPECT_EQ(flat.quantile(0.995), 5);
  EXPECT_DOUBLE_EQ(flat.mean(), 0.05);
}

}  // namespace
}  // namespace terrabench
