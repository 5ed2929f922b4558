#include "representations/tin/tin_codec.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "terrain/error.h"
#include "terrain/source.h"

namespace terrabench::tin {
namespace {

Approximation surface_of(const Heightfield& field, float error) {
  Progress progress;
  return greedy_insertion(field, error, progress);
}

std::vector<std::byte> encoded(const Approximation& surface, const Heightfield& field, double step) {
  ByteSink out;
  encode(surface, field.width, field.depth, step, out);
  return {out.bytes().begin(), out.bytes().end()};
}

TEST(TinCodec, KeepsVerticesHolesAndWholeMetres) {
  Heightfield field = *open_terrain("jacksboro").heights;
  for (float& h : field.heights) h = std::round(h);
  for (int j = 50; j < 80; ++j) {
    for (int i = 20; i < 90; ++i) field.at(i, j) = Heightfield::kNoData;
  }
  field.at(0, 0) = Heightfield::kNoData;
  const Approximation surface = surface_of(field, 20);
  const std::vector<std::byte> bytes = encoded(surface, field, 1);
  ByteSource in(bytes, "test");
  const Approximation again = decode(in, field.width, field.depth);
  EXPECT_EQ(again.surface.vertices(), surface.surface.vertices());
  EXPECT_EQ(again.holes, surface.holes);
  ASSERT_EQ(again.heights.size(), surface.heights.size());
  for (std::size_t v = 0; v < surface.heights.size(); ++v) {
    if (!std::isnan(surface.heights[v])) {
      ASSERT_EQ(again.heights[v], surface.heights[v]) << v;
    } else {
      ASSERT_TRUE(std::isnan(again.heights[v])) << v;
    }
  }
}

TEST(TinCodec, RoundsToTheStep) {
  const Heightfield field = *open_terrain("jacksboro").heights;
  const Approximation surface = surface_of(field, 30);
  const std::vector<std::byte> bytes = encoded(surface, field, 7);
  ByteSource in(bytes, "test");
  const Approximation again = decode(in, field.width, field.depth);
  for (std::size_t v = 0; v < surface.heights.size(); ++v)
    ASSERT_NEAR(again.heights[v], surface.heights[v], 3.501);
  // Fewer than the 4 + 4 bytes of a place and a float.
  EXPECT_LT(bytes.size(), 3 * surface.heights.size());
}

TEST(TinCodec, RefusesDamagedBytes) {
  Heightfield field = Heightfield::zeros(30, 20);
  for (std::size_t k = 0; k < field.heights.size(); ++k) field.heights[k] = static_cast<float>(k * k % 37);
  const std::vector<std::byte> good = encoded(surface_of(field, 3), field, 1);
  for (std::size_t length = 0; length < good.size(); ++length) {
    ByteSource in(std::span<const std::byte>(good).first(length), "test");
    EXPECT_ANY_THROW(decode(in, 30, 20)) << length;
  }
  std::mt19937 random(3);
  for (int k = 0; k < 300; ++k) {
    std::vector<std::byte> bad = good;
    bad[random() % bad.size()] ^= static_cast<std::byte>(1 + random() % 255);
    ByteSource in(bad, "test");
    try {
      EXPECT_GE(decode(in, 30, 20).heights.size(), 4U);
    } catch (const Error&) {
    }
  }
}

}  // namespace
}  // namespace terrabench::tin
