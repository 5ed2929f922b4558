#include "terrain/sources/dem/compressed_sizes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/terrain/errors.h"
#include "tests/terrain/ground.h"

namespace terrabench {
namespace {

constexpr RasterCodec kCodecs[] = {RasterCodec::kZstd, RasterCodec::kZstdDifferences, RasterCodec::kJpeg2000,
                                   RasterCodec::kLerc, RasterCodec::kLercDeflate};

Heightfield waves(int width, int depth, bool whole) {
  const auto height = [](int i, int j) {
    return 300 + 90 * std::sin(0.07F * static_cast<float>(i)) * std::cos(0.05F * static_cast<float>(j)) +
           static_cast<float>((i * 7919 + j * 104729) % 13);
  };
  const Heightfield field = test::ground_of(width, depth, height, 30, 30);
  return whole ? test::rounded(field) : field;
}

TEST(CompressedSizes, WholeMetresAreKeptWithoutLoss) {
  const Heightfield field = waves(120, 90, true);
  for (const auto& [codec, setting] : {std::pair{RasterCodec::kZstd, 1.0},
                                       {RasterCodec::kZstdDifferences, 1.0},
                                       {RasterCodec::kJpeg2000, 100.0},
                                       {RasterCodec::kLerc, 0.0},
                                       {RasterCodec::kLercDeflate, 0.0}}) {
    const CompressedSize size = compressed_size(field, codec, setting);
    EXPECT_EQ(size.rmse, 0) << name(codec);
    EXPECT_GT(size.bytes, 1000U) << name(codec);
    EXPECT_LT(size.bytes, field.heights.size() * 5) << name(codec);
  }
}

TEST(CompressedSizes, ShrinkAsTheErrorGrowsAndKeepWithinIt) {
  const Heightfield field = waves(150, 100, false);
  for (const RasterCodec codec : kCodecs) {
    std::size_t before = field.heights.size() * 5;
    for (const double rmse : {1.0, 4.0, 15.0}) {
      const CompressedSize size = compressed_size_at(field, codec, rmse);
      EXPECT_LE(size.rmse, rmse) << name(codec);
      EXPECT_LT(size.bytes, before) << name(codec);
      before = size.bytes;
      const CompressedSize again = compressed_size(field, codec, size.setting);
      EXPECT_EQ(again.bytes, size.bytes);
      EXPECT_EQ(again.rmse, size.rmse);
    }
  }
}

// Smooth ground has almost nothing but its coarsest resolutions.
TEST(CompressedSizes, Jpeg2000HasResolutionsForSmoothGround) {
  const Heightfield field = test::ground_of(
      400, 300,
      [](int i, int j) {
        return 300 + 90 * std::sin(0.07F * static_cast<float>(i)) * std::cos(0.05F * static_cast<float>(j));
      },
      30, 30);
  const CompressedSize size = compressed_size_at(field, RasterCodec::kJpeg2000, 1);
  EXPECT_LE(size.rmse, 1);
  EXPECT_LT(size.bytes, 1500U);  // 3,900 with the two resolutions that GDAL would choose
}

TEST(CompressedSizes, LercKeepsItsPromise) {
  const Heightfield field = waves(64, 64, false);
  EXPECT_LE(compressed_size(field, RasterCodec::kLerc, 2).rmse, 2);
  EXPECT_GT(compressed_size(field, RasterCodec::kLerc, 2).rmse, 0.5);
  EXPECT_EQ(compressed_size(field, RasterCodec::kLercDeflate, 2).rmse,
            compressed_size(field, RasterCodec::kLerc, 2).rmse);
}

TEST(CompressedSizes, DeflateFindsWhatLercLeaves) {
  // The same wave again and again: blocks of LERC that repeat.
  Heightfield field{256, 256, 30, 30, {}, {}};
  for (int j = 0; j < 256; ++j) {
    for (int i = 0; i < 256; ++i) field.heights.push_back(static_cast<float>((i * 37 + j * 11) % 8 * 50));
  }
  EXPECT_LT(2 * compressed_size(field, RasterCodec::kLercDeflate, 1).bytes,
            compressed_size(field, RasterCodec::kLerc, 1).bytes);
}

// A block's header and one height, without a file around it.
TEST(CompressedSizes, LercIsCountedWithoutItsContainer) {
  const Heightfield flat{70, 70, 1, 1, std::vector<float>(4900, 3), {}};
  EXPECT_LT(compressed_size(flat, RasterCodec::kLerc, 1).bytes, 200U);
  EXPECT_GT(compressed_size(flat, RasterCodec::kLerc, 1).bytes, 20U);
}

TEST(CompressedSizes, OfFlatAndTinyFields) {
  for (const Heightfield& field :
       {Heightfield{1, 1, 1, 1, {5}, {}}, Heightfield{70, 70, 1, 1, std::vector<float>(4900, -3), {}}}) {
    for (const RasterCodec codec : kCodecs) EXPECT_EQ(compressed_size_at(field, codec, 1).rmse, 0);
  }
}

// The samples that are there have the errors of the setting, however the holes are filled.
TEST(CompressedSizes, HolesHaveNoErrorAndTakeAMask) {
  const Heightfield whole = waves(120, 90, true);
  Heightfield field = whole;
  for (std::size_t i = 0; i < field.heights.size(); ++i) {
    if (i % 120 < 48) field.heights[i] = Heightfield::kNoData;  // 40 %
  }
  for (const auto& [codec, setting] : {std::pair{RasterCodec::kZstdDifferences, 1.0},
                                       {RasterCodec::kJpeg2000, 100.0},
                                       {RasterCodec::kLerc, 0.0}}) {
    const CompressedSize size = compressed_size(field, codec, setting);
    EXPECT_EQ(size.largest, 0) << name(codec);
    EXPECT_LT(size.bytes, compressed_size(whole, codec, setting).bytes) << name(codec);
    Heightfield raised = field;
    raised.heights[60] += 1;  // beside the holes
    EXPECT_EQ(compressed_size(raised, codec, setting).largest, 0) << name(codec);
  }
  // Two fields whose holes are filled alike differ by their masks.
  Heightfield flat = test::ground_of(
      64, 64, [](int, int) { return 5.0F; }, 1, 1);
  const std::size_t full = compressed_size(flat, RasterCodec::kZstd, 1).bytes;
  for (std::size_t i = 0; i < flat.heights.size(); i += 3 + i % 5) flat.heights[i] = Heightfield::kNoData;
  EXPECT_GT(compressed_size(flat, RasterCodec::kZstd, 1).bytes, full + 20);
}

TEST(CompressedSizes, SettingsAndFieldsThatCannotBeAreRefused) {
  Heightfield field = waves(40, 40, false);
  const auto code = [&](RasterCodec codec, double setting) {
    return failure_of([&] { compressed_size(field, codec, setting); }).code;
  };
  EXPECT_EQ(code(RasterCodec::kZstd, 0), ExitCode::kUsage);
  EXPECT_EQ(code(RasterCodec::kZstd, -1), ExitCode::kUsage);
  EXPECT_EQ(code(RasterCodec::kZstdDifferences, 1e-6), ExitCode::kUsage);
  EXPECT_EQ(code(RasterCodec::kJpeg2000, 0), ExitCode::kUsage);
  EXPECT_EQ(code(RasterCodec::kJpeg2000, 101), ExitCode::kUsage);
  EXPECT_EQ(code(RasterCodec::kLerc, -1), ExitCode::kUsage);
  EXPECT_EQ(code(RasterCodec::kLerc, std::nan("")), ExitCode::kUsage);
  EXPECT_EQ(code(RasterCodec::kLercDeflate, -1), ExitCode::kUsage);
  std::ranges::fill(field.heights, Heightfield::kNoData);
  for (const RasterCodec codec : kCodecs) EXPECT_EQ(code(codec, 1), ExitCode::kBadInput);
}

}  // namespace
}  // namespace terrabench
