#include "representations/coding/height_codec.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "terrain/error.h"
#include "terrain/source.h"

namespace terrabench {
namespace {

std::vector<float> reread(std::span<const float> heights, int width, double step,
                          std::size_t* bytes = nullptr) {
  ByteSink out;
  encode_heights(heights, width, step, out);
  if (bytes != nullptr) *bytes = out.bytes().size();
  ByteSource in(out.bytes(), "test");
  return decode_heights(in, width, static_cast<int>(heights.size()) / width);
}

TEST(HeightCodec, KeepsWholeMetresAndTheHolesAmongThem) {
  Heightfield field = *open_terrain("jacksboro").heights;
  for (float& h : field.heights) h = std::round(h);
  std::mt19937 random(1);
  for (float& h : field.heights) {
    if (random() % 4 == 0) h = Heightfield::kNoData;
  }
  ASSERT_EQ(step_for(field.heights, 0), 1);
  const std::vector<float> again = reread(field.heights, field.width, 1);
  for (std::size_t k = 0; k < again.size(); ++k) {
    ASSERT_EQ(std::isnan(again[k]), std::isnan(field.heights[k]));
    if (!std::isnan(again[k])) {
      ASSERT_EQ(again[k], field.heights[k]);
    }
  }
}

TEST(HeightCodec, KeepsTheLargestError) {
  std::mt19937 random(2);
  std::uniform_real_distribution<float> height(-300, 4000);
  std::vector<float> heights(97 * 31);
  for (float& h : heights) h = height(random);
  for (const double error : {0.01, 0.5, 20.0, 5000.0}) {
    const std::vector<float> again = reread(heights, 97, step_for(heights, error));
    for (std::size_t k = 0; k < again.size(); ++k) {
      ASSERT_NEAR(again[k], heights[k], error * (1 + 1e-6) + 1e-3) << error;
    }
  }
}

// As for whole samples in JPEG-LS: to within 1 m, three neighbouring heights are one.
TEST(HeightCodec, TakesLongerStepsForWholeMetres) {
  const std::vector<float> heights = {3, 4, 5, 17};
  EXPECT_EQ(step_for(heights, 1), 3);
  EXPECT_EQ(step_for(heights, 0.4), 1);
  EXPECT_EQ(step_for(std::vector<float>{3, 4.3717F}, 1), 2);
  EXPECT_NEAR(step_for(std::vector<float>{3.1F, 4.4F}, 0.1), 0.3, 1e-9);
}

// What a coder without prediction, or without adapting to its surroundings, does not reach: the entropy of
// the differences of a smooth slope beside rough ground.
TEST(HeightCodec, TakesLittleForAPlane) {
  std::vector<float> heights;
  for (int j = 0; j < 200; ++j) {
    for (int i = 0; i < 200; ++i) heights.push_back(static_cast<float>(3 * i - 2 * j));
  }
  std::size_t bytes = 0;
  EXPECT_EQ(reread(heights, 200, 1, &bytes), heights);
  EXPECT_LT(bytes, 400U);
}

TEST(HeightCodec, RefusesDamagedBytes) {
  std::vector<float> heights(400);
  for (std::size_t k = 0; k < heights.size(); ++k) heights[k] = static_cast<float>(k * k % 37);
  ByteSink out;
  encode_heights(heights, 20, 1, out);
  const std::vector<std::byte> good(out.bytes().begin(), out.bytes().end());
  for (std::size_t length = 0; length < good.size(); ++length) {
    ByteSource in(std::span<const std::byte>(good).first(length), "test");
    EXPECT_ANY_THROW(decode_heights(in, 20, 20)) << length;
  }
  std::mt19937 random(3);
  for (int k = 0; k < 300; ++k) {
    std::vector<std::byte> bad = good;
    bad[random() % bad.size()] ^= static_cast<std::byte>(1 + random() % 255);
    ByteSource in(bad, "test");
    try {
      EXPECT_EQ(decode_heights(in, 20, 20).size(), 400U);
    } catch (const Error&) {
    }
  }
}

}  // namespace
}  // namespace terrabench
